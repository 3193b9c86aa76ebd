//! BUSHING, FIELD and BEAM to components along the axes of J.

use dataset::{Beam, BeamDamping, Bushing, Field, Function};
use mechanics::expression::{Binary, Operation, Program, Register};
use mechanics::model::{Label, Model};

use super::forces::component_force;
use super::{Lowering, label};

/// A matrix by rows over three displacements and three rotations.
type Matrix = [[f64; 6]; 6];

/// `−K (q − q₀) − C q' + P`, where `q` are the displacements and projected angles of I in J and `q'`
/// the velocities and angular velocities of I seen from J, all along the axes of J.
struct Linear {
    i: u32,
    j: u32,
    stiffness: Matrix,
    damping: Matrix,
    free: [f64; 6],
    preload: [f64; 6],
}

impl From<&Bushing> for Linear {
    fn from(bushing: &Bushing) -> Self {
        Self {
            i: bushing.i,
            j: bushing.j,
            stiffness: diagonal(bushing.stiffness, bushing.torsional_stiffness),
            damping: diagonal(bushing.damping, bushing.torsional_damping),
            free: [0.0; 6],
            preload: joined(bushing.force, bushing.torque),
        }
    }
}

impl From<&Field> for Linear {
    fn from(field: &Field) -> Self {
        Self {
            i: field.i,
            j: field.j,
            stiffness: field.stiffness,
            damping: field.damping,
            free: field.free,
            preload: field.preload,
        }
    }
}

impl From<&Beam> for Linear {
    fn from(beam: &Beam) -> Self {
        let stiffness = timoshenko(beam);
        Self {
            i: beam.i,
            j: beam.j,
            damping: match &beam.damping {
                BeamDamping::Ratio(ratio) => stiffness.map(|row| row.map(|k| ratio * k)),
                BeamDamping::Matrix(matrix) => **matrix,
            },
            stiffness,
            free: [beam.length, 0.0, 0.0, 0.0, 0.0, 0.0],
            preload: [0.0; 6],
        }
    }
}

fn joined([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 6] {
    [a, b, c, d, e, f]
}

fn diagonal(translation: [f64; 3], rotation: [f64; 3]) -> Matrix {
    let mut matrix = [[0.0; 6]; 6];
    for (place, value) in joined(translation, rotation).into_iter().enumerate() {
        matrix[place][place] = value;
    }
    matrix
}

/// Stiffness at the end of a straight beam whose other end is clamped: Przemieniecki, *Theory of
/// Matrix Structural Analysis*, section 5.6, with `Φ = 12 E I A_S / (G A L²)` for shear.
fn timoshenko(beam: &Beam) -> Matrix {
    let Beam {
        length: l,
        area,
        young,
        shear_modulus,
        ..
    } = *beam;
    let shear =
        |moment: f64, ratio: f64| 12.0 * young * moment * ratio / (shear_modulus * area * l * l);
    let (iy, iz) = (beam.moment_y, beam.moment_z);
    let (phi_y, phi_z) = (shear(iz, beam.shear_y), shear(iy, beam.shear_z));
    let bending_z = young * iz / (l * (1.0 + phi_y));
    let bending_y = young * iy / (l * (1.0 + phi_z));
    let mut k = [[0.0; 6]; 6];
    k[0][0] = young * area / l;
    k[1][1] = 12.0 * bending_z / (l * l);
    k[2][2] = 12.0 * bending_y / (l * l);
    k[3][3] = shear_modulus * beam.torsional_constant / l;
    k[4][4] = (4.0 + phi_z) * bending_y;
    k[5][5] = (4.0 + phi_y) * bending_z;
    // A deflection along y comes with a positive slope about z, one along z with a negative one
    // about y.
    k[1][5] = -6.0 * bending_z / l;
    k[5][1] = k[1][5];
    k[2][4] = 6.0 * bending_y / l;
    k[4][2] = k[2][4];
    k
}

/// Displacements and projected angles of I in J; the first three along the axes of J.
const COORDINATES: [Function; 6] = [
    Function::Dx,
    Function::Dy,
    Function::Dz,
    Function::Ax,
    Function::Ay,
    Function::Az,
];

/// Their rates: velocities seen from J and angular velocities against J, along the axes of J.
const RATES: [Function; 6] = [
    Function::Vx,
    Function::Vy,
    Function::Vz,
    Function::Wx,
    Function::Wy,
    Function::Wz,
];

impl Lowering<'_> {
    /// Bushings, fields and beams in the order of the dataset.
    pub(super) fn elastic_forces(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        for bushing in &dataset.bushings {
            self.linear(model, &label("BUSHING", &bushing.header), &bushing.into());
        }
        for field in &dataset.fields {
            self.linear(model, &label("FIELD", &field.header), &field.into());
        }
        for beam in &dataset.beams {
            self.linear(model, &label("BEAM", &beam.header), &beam.into());
        }
    }

    /// Six components on I at its origin, the opposite on J's body at the same point.
    fn linear(&mut self, model: &mut Model, label: &Label, linear: &Linear) {
        let [i, j] = [linear.i, linear.j].map(|id| self.marker_place(id));
        for component in 0..6 {
            let mut program = Program::default();
            let mut sum = constant(&mut program, linear.preload[component]);
            for other in 0..6 {
                let stiffness = linear.stiffness[component][other];
                if stiffness != 0.0 {
                    let measured =
                        self.measured(&mut program, COORDINATES[other], linear.i, linear.j);
                    let free = constant(&mut program, linear.free[other]);
                    let stretch = binary(&mut program, Binary::Subtract, measured, free);
                    sum = less(&mut program, sum, stiffness, stretch);
                }
                let damping = linear.damping[component][other];
                if damping != 0.0 {
                    let rate = self.measured(&mut program, RATES[other], linear.i, linear.j);
                    sum = less(&mut program, sum, damping, rate);
                }
            }
            let force = component_force(label.clone(), [i, j, j], component, program);
            model.forces.push(force);
        }
    }
}

fn constant(program: &mut Program, value: f64) -> Register {
    program.push(Operation::Constant(value))
}

fn binary(program: &mut Program, function: Binary, a: Register, b: Register) -> Register {
    program.push(Operation::Binary(function, a, b))
}

/// `sum − factor x`; it is the last operation of the program.
fn less(program: &mut Program, sum: Register, factor: f64, x: Register) -> Register {
    let factor = constant(program, factor);
    let product = binary(program, Binary::Multiply, factor, x);
    binary(program, Binary::Subtract, sum, product)
}
