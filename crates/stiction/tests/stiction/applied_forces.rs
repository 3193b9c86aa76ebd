//! Forces of six components against closed forms: VFORCE, VTORQUE, GFORCE, BUSHING, FIELD, BEAM.

use results::ResFile;

use crate::shared::{last, run_text};

/// Components X, Y, Z of an entity with a prefix (`V`, `W`, `AC`...) at every instant.
fn vectors(results: &ResFile, entity: &str, prefix: &str) -> Vec<[f64; 3]> {
    let column = |axis: &str| results.get(&format!("{entity}.{prefix}{axis}")).unwrap();
    let [x, y, z] = ["X", "Y", "Z"].map(column);
    (0..x.len()).map(|k| [x[k], y[k], z[k]]).collect()
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

#[test]
fn a_vector_force_accelerates_along_the_axes_of_its_marker() {
    // RM is turned by 90 degrees about z: its x is the ground's y, its y the ground's -x.
    let text = "vector force
PART/1, GROUND
MARKER/1, PART=1, REULER=90D, 0, 0
MARKER/2, PART=1, FLOATING
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
VFORCE/1, I=20, JFLOAT=2, RM=1, FX=4\\FY=6*TIME\\FZ=-2
REQUEST/1, F2=VFORCE(1,0,2,0)\\F3=VFORCE(1,1,3,1)\\F4=FZ(20,2)\\F6=VFORCE(1,0,1,0)\\
END
";
    let results = run_text(text, 2.0, 10, Some(1e-8));
    // m x'' = -6 t, m y'' = 4, m z'' = -2; integration to 1e-8 of lengths of order 4.
    let found = ["X", "Y", "Z"].map(|axis| last(&results, &format!("PART_2_XFORM.{axis}")));
    for (found, wanted) in found.into_iter().zip([-4.0, 4.0, -2.0]) {
        assert!((found - wanted).abs() < 1e-6, "{found} for {wanted}");
    }
    let force = ["FX", "FY", "FZ", "TX"].map(|axis| last(&results, &format!("VFORCE_1.{axis}")));
    let wanted = [-12.0, 4.0, -2.0, 0.0];
    for (found, wanted) in force.into_iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}");
    }
    // Along x in ground; on J along y of RM; of the pair of markers; the magnitude.
    let magnitude = (144.0_f64 + 16.0 + 4.0).sqrt();
    let functions =
        ["F2", "F3", "F4", "F6"].map(|name| last(&results, &format!("REQUEST_1.{name}")));
    for (found, wanted) in functions.into_iter().zip([-12.0, -12.0, -2.0, magnitude]) {
        assert!((found - wanted).abs() < 1e-12, "{found} for {wanted}");
    }
}

#[test]
fn a_vector_torque_along_the_axes_of_its_body_spins_a_rotor_up() {
    // Euler's equations of a symmetric rotor under a torque about its own axis: the spin grows by
    // T t / C, and the transverse angular velocity turns in the body by (C - A)/A times the angle
    // of the spin.
    let text = "rotor
PART/1, GROUND
MARKER/2, PART=1, FLOATING
PART/2, MASS=1, CM=20, IP=2, 2, 3, WX=0.5, WZ=1
MARKER/20, PART=2
MARKER/1, PART=1
VTORQUE/1, I=20, JFLOAT=2, RM=20, TZ=6\\
REQUEST/1, F2=WX(20,1,20)\\F3=WY(20,1,20)\\F4=WZ(20,1,20)\\
END
";
    let results = run_text(text, 2.0, 40, Some(1e-9));
    let (t, growth) = (2.0_f64, 6.0 / 3.0);
    let angle = (3.0 - 2.0) / 2.0 * (t + 0.5 * growth * t * t);
    // p' = -(C - A)/A r q and q' = (C - A)/A r p.
    let wanted = [0.5 * angle.cos(), 0.5 * angle.sin(), 1.0 + growth * t];
    for (name, wanted) in ["F2", "F3", "F4"].into_iter().zip(wanted) {
        let found = last(&results, &format!("REQUEST_1.{name}"));
        // The integrator's error of 1e-9 a step over some thousand steps.
        assert!(
            (found - wanted).abs() < 1e-6,
            "{name}: {found} for {wanted}"
        );
    }
}

#[test]
fn action_and_reaction_keep_the_momenta_of_free_bodies() {
    // The components turn with a third body, which feels nothing.
    let text = "two bodies
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1, VX=0.3, WY=1
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.3, 0.1, -0.2
PART/3, MASS=3, CM=30, IP=2, 2, 2, QG=1, 0.5, -0.4, VY=-0.2, WZ=0.7
MARKER/30, PART=3
MARKER/31, PART=3, FLOATING
MARKER/32, PART=3, QP=0.1, -0.4, 0.2, REULER=20D, 30D, 40D
PART/4, MASS=1, CM=41, IP=1, 1, 1, WX=1.5, WY=0.5
MARKER/41, PART=4
MARKER/40, PART=4, REULER=10D, 70D, 0
GFORCE/1, I=21, JFLOAT=31, RM=40
, FX=-4*DX(21,32,40)-0.1*VX(21,32,40)\\
, FY=2+SIN(3*TIME)\\
, FZ=-5*DZ(21,32,40)\\
, TX=0.5*WX(21,32,40)\\
, TY=-2*AZ(21,32)\\
, TZ=0.3\\
BUSHING/1, I=20, J=32, K=3, 4, 5, KT=0.2, 0.3, 0.1, C=0.1, 0.2, 0.3, CT=0.1, 0.1, 0.1
, FORCE=1, 2, 3, TORQUE=0.3, 0.2, 0.1
END
";
    let results = run_text(text, 3.0, 30, Some(1e-8));
    let masses = [("PART_2_XFORM", 2.0, 1.0), ("PART_3_XFORM", 3.0, 2.0)];
    let count = results.get("PART_2_XFORM.X").unwrap().len();
    let mut momenta = vec![[0.0; 6]; count];
    for (entity, mass, inertia) in masses {
        let [place, velocity, spin] =
            ["", "V", "W"].map(|prefix| vectors(&results, entity, prefix));
        for (k, momentum) in momenta.iter_mut().enumerate() {
            let orbit = cross(place[k], velocity[k]);
            for axis in 0..3 {
                momentum[axis] += mass * velocity[k][axis];
                momentum[3 + axis] += mass * orbit[axis] + inertia * spin[k][axis];
            }
        }
    }
    // The first row is the dataset as given, before assembly.
    for momentum in &momenta[1..] {
        for (now, start) in momentum.iter().zip(momenta[1]) {
            // Forces of order ten act for 3 s at an error of 1e-8 a step.
            assert!((now - start).abs() < 1e-5, "{now} and {start}");
        }
    }
    // The third body turns freely: its inertia is that of a sphere.
    assert!((last(&results, "PART_4_XFORM.WX") - 1.5).abs() < 1e-9);
    // The bodies have moved: the forces are not zero.
    assert!((last(&results, "PART_2_XFORM.VX") - 0.3).abs() > 0.1);
}

#[test]
fn a_bushing_rings_at_its_frequencies() {
    // Along x damped: x = e^(-d t) (cos w t + d/w sin w t) x0; about z undamped.
    let text = "bushing
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 0, 0
PART/2, MASS=2, CM=20, IP=1, 1, 0.5, QG=0.1, 0, 0, REULER=5D, 0, 0
MARKER/20, PART=2
BUSHING/1, I=20, J=1, K=200, 300, 400, KT=10, 20, 50, C=4, 0, 0
REQUEST/1, F2=BUSH(1,0,2,0)\\F3=BUSH(1,1,2,0)\\F4=BUSH(1,0,8,0)\\F6=AZ(20,1)\\
END
";
    let results = run_text(text, 2.0, 50, Some(1e-9));
    let (t, decay) = (2.0_f64, 4.0 / (2.0 * 2.0));
    let w = (200.0_f64 / 2.0 - decay * decay).sqrt();
    let x = 0.1 * (-decay * t).exp() * ((w * t).cos() + decay / w * (w * t).sin());
    let found = last(&results, "PART_2_XFORM.X");
    // The integrator's error of 1e-9 a step over some thousand steps.
    assert!((found - x).abs() < 1e-6, "{found} {x}");
    let angle = 5.0_f64.to_radians() * ((50.0_f64 / 0.5).sqrt() * t).cos();
    let found = last(&results, "REQUEST_1.F6");
    assert!((found - angle).abs() < 1e-6, "{found} {angle}");
    let force = |name: &str| last(&results, &format!("REQUEST_1.{name}"));
    let velocity = last(&results, "PART_2_XFORM.VX");
    let wanted = -200.0 * last(&results, "PART_2_XFORM.X") - 4.0 * velocity;
    assert!((force("F2") - wanted).abs() < 1e-9);
    assert!((force("F2") + force("F3")).abs() < 1e-12);
    assert!((force("F4") + 50.0 * found).abs() < 1e-9);
}

/// The model of a massive end of a beam or field along x under tip loads, at rest at equilibrium.
fn tip(element: &str, loads: &str) -> ResFile {
    let text = format!(
        "tip
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, FLOATING
PART/2, MASS=1, CM=20, IP=1, 1, 1, QG=2, 0, 0
MARKER/20, PART=2
{element}
GFORCE/1, I=20, JFLOAT=2, RM=1, {loads}
REQUEST/1, F2=DY(20,1)\\F3=DZ(20,1)\\F4=DX(20,1)\\F5=AX(20,1)\\F6=AY(20,1)\\F7=AZ(20,1)\\
END
"
    );
    equilibrium(&text)
}

fn equilibrium(text: &str) -> ResFile {
    let folder = crate::shared::scratch_folder();
    std::fs::write(folder.join("tip.adm"), text).unwrap();
    let commands = "\nFILE/MODEL=tip\nSIMULATE/STATIC\nSTOP\n";
    std::fs::write(folder.join("tip.acf"), commands).unwrap();
    let project =
        stiction::Project::load(&folder.join("tip.acf")).unwrap_or_else(|e| panic!("{e}"));
    let results = crate::shared::complete(&project, None);
    std::fs::remove_dir_all(folder).unwrap();
    results
}

#[test]
fn a_cantilever_bends_as_in_the_textbook() {
    // L = 2, E Iz = 1000 * 3, E Iy = 1000 * 5, G A / (shear ratio): loads small enough for angles.
    let (l, e, g) = (2.0, 1000.0, 400.0);
    let (area, ix, iy, iz, asy, asz) = (10.0, 4.0, 5.0, 3.0, 1.2, 1.1);
    let element = format!(
        "BEAM/1, I=20, J=1, LENGTH={l}, AREA={area}, IXX={ix}, IYY={iy}, IZZ={iz}
, ASY={asy}, ASZ={asz}, EMODULUS={e}, GMODULUS={g}, CRATIO=0.01, FORMULATION=LINEAR"
    );
    let f = 1e-3;
    let results = tip(&element, &format!("FX={f}\\FY={f}\\FZ={f}\\TX={f}\\"));
    // Timoshenko: F L^3/(3 E I) + ratio F L/(G A), slope F L^2/(2 E I); stretch and twist.
    let shear = |ratio: f64| ratio * f * l / (g * area);
    let wanted = [
        ("F2", f * l.powi(3) / (3.0 * e * iz) + shear(asy)),
        ("F3", f * l.powi(3) / (3.0 * e * iy) + shear(asz)),
        ("F4", l + f * l / (e * area)),
        ("F5", f * l / (g * ix)),
        ("F6", -f * l * l / (2.0 * e * iy)),
        ("F7", f * l * l / (2.0 * e * iz)),
    ];
    for (name, wanted) in wanted {
        let found = last(&results, &format!("REQUEST_1.{name}"));
        // Products of angles and displacements are a part 1e-6 of them; they are of order 1e-6.
        assert!((found - wanted).abs() < 1e-11, "{name}: {found} {wanted}");
    }
    // The clamp holds the force and the moments of the lever: Tz = F L, Ty = -F L.
    assert!((last(&results, "BEAM_1.FY") + f).abs() < 1e-9);
}

#[test]
fn a_field_is_its_matrix_by_columns() {
    // Stiffness by columns; the entry in row 2, column 1 couples the force along y to x.
    let element = "FIELD/1, I=20, J=1, KMATRIX =
, 100, 10, 0, 0, 0, 0
, 0, 200, 0, 0, 0, 0
, 0, 0, 300, 0, 0, 0
, 0, 0, 0, 40, 0, 0
, 0, 0, 0, 0, 50, 0
, 0, 0, 0, 0, 0, 60
, CRATIO = 0.1, LENGTH = 1.9, 0.1, 0, 0, 0, 0, FORCE = 1, 0, 0, 0, 0, 0.06";
    let requests = "FX=2\\
REQUEST/2, F2=FIELD(1,0,2,1)\\F3=FIELD(1,1,8,1)\\F4=GFORCE(1,0,2,1)\\F6=GFORCE(1,1,2,1)\\
, F7=GFORCE(1,1,8,1)\\";
    let results = tip(element, requests);
    // 100 (x - 1.9) = 1 + 2; 10 (x - 1.9) + 200 (y - 0.1) = 0; 60 c = 0.06.
    let (x, y) = (1.93, 0.1 - 10.0 * 0.03 / 200.0);
    for (name, wanted) in [("F4", x), ("F2", y), ("F3", 0.0), ("F7", 0.001)] {
        let found = last(&results, &format!("REQUEST_1.{name}"));
        // The imbalance left by the static solver, 1e-10 of the forces.
        assert!((found - wanted).abs() < 1e-9, "{name}: {found} {wanted}");
    }
    // The field balances the load; on J its force acts with the arm (x, y), on JFLOAT the load has
    // none.
    let forces = [
        ("F2", -2.0),
        ("F3", -2.0 * y),
        ("F4", 2.0),
        ("F6", -2.0),
        ("F7", 0.0),
    ];
    for (name, wanted) in forces {
        let found = last(&results, &format!("REQUEST_2.{name}"));
        assert!((found - wanted).abs() < 1e-8, "{name}: {found} {wanted}");
    }
}

#[test]
fn commands_switch_and_change_a_vector_force() {
    let text = "switched
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, FLOATING
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
VFORCE/1, I=20, JFLOAT=2, RM=1, FX=4\\FY=6\\
END
";
    let commands = "
FILE/MODEL=switched
SIMULATE/DYNAMIC, END=1, STEPS=1
DEACTIVATE/VFORCE, ID=1
SIMULATE/DYNAMIC, END=2, STEPS=1
ACTIVATE/VFORCE, ID=1
VFORCE/1, FX=-4\\
SIMULATE/DYNAMIC, END=3, STEPS=1
STOP
";
    let folder = crate::shared::scratch_folder();
    std::fs::write(folder.join("switched.adm"), text).unwrap();
    std::fs::write(folder.join("switched.acf"), commands).unwrap();
    let file = folder.join("switched.acf");
    let project = stiction::Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let results = crate::shared::complete(&project, None);
    std::fs::remove_dir_all(folder).unwrap();
    // 2 for a second, nothing for a second, -2 along x and still 3 along y for a second.
    assert!(last(&results, "PART_2_XFORM.VX").abs() < 1e-9);
    assert!((last(&results, "PART_2_XFORM.VY") - 6.0).abs() < 1e-9);
    assert!((last(&results, "VFORCE_1.FX") + 4.0).abs() < 1e-12);
}

#[test]
fn a_chain_of_beams_bends_like_one_beam() {
    // Ten steel beams in a row: their axial stiffness makes hundreds of newtons of the stretch that
    // the first step of a static solution leaves.
    use std::fmt::Write;
    let (count, length, load, stiffness) = (10_u32, 1.0, 10.0, 2e11 * 1e-8);
    let part = length / f64::from(count);
    let mut text = "chain
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, FLOATING
"
    .to_owned();
    for k in 1..=count {
        let (id, x) = (k + 1, f64::from(k) * part);
        let j = if k == 1 { 1 } else { 10 * k };
        write!(
            text,
            "PART/{id}, MASS=0.78, CM={id}0, IP=1E-3, 1E-3, 1E-3, QG={x}, 0, 0
MARKER/{id}0, PART={id}
BEAM/{k}, I={id}0, J={j}, LENGTH={part}, AREA=1E-3, IXX=2E-8, IYY=1E-8, IZZ=1E-8
, EMODULUS=2E11, GMODULUS=8E10
"
        )
        .unwrap();
    }
    text += "VFORCE/1, I=110, JFLOAT=2, RM=1, FY=-10\\
REQUEST/1, F2=DY(110,1)\\F3=AZ(110,1)\\F4=BEAM(1,1,8,1)\\
END
";
    let results = equilibrium(&text);
    let [deflection, slope, moment] =
        ["F2", "F3", "F4"].map(|name| last(&results, &format!("REQUEST_1.{name}")));
    let wanted = -load * length.powi(3) / (3.0 * stiffness);
    // Finite rotations change a part of 6e-6, the square of the slope of 2.5e-3, times less than one.
    assert!(
        (deflection / wanted - 1.0).abs() < 1e-5,
        "{deflection} {wanted}"
    );
    let wanted = -load * length * length / (2.0 * stiffness);
    assert!((slope / wanted - 1.0).abs() < 1e-5, "{slope} {wanted}");
    // On ground: the whole lever, about z.
    assert!((moment + load * length).abs() < 1e-4, "{moment}");
}

#[test]
fn a_bushing_without_torsion_keeps_the_energy_of_two_free_bodies() {
    // Its force and the reaction, at the same point, have the potential K x^2/2 along turning axes.
    let text = "energy
PART/1, GROUND
PART/2, MASS=2, CM=20, IP=1, 1, 1, VX=0.3, WY=1
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.3, 0.1, -0.2
PART/3, MASS=3, CM=30, IP=2, 2, 2, QG=1, 0.5, -0.4, VY=-0.2, WZ=0.7, WX=1
MARKER/30, PART=3
MARKER/31, PART=3, QP=0.1, -0.4, 0.2, REULER=20D, 30D, 40D
BUSHING/1, I=21, J=31, K=30, 4, 15
REQUEST/1, F2=DX(21,31,31)\\F3=DY(21,31,31)\\F4=DZ(21,31,31)\\
END
";
    let results = run_text(text, 4.0, 40, Some(1e-9));
    let square = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>();
    let mut energies = vec![0.0; results.get("REQUEST_1.F2").unwrap().len()];
    for (entity, mass, inertia) in [("PART_2_XFORM", 2.0, 1.0), ("PART_3_XFORM", 3.0, 2.0)] {
        let [velocity, spin] = ["V", "W"].map(|prefix| vectors(&results, entity, prefix));
        for (k, energy) in energies.iter_mut().enumerate() {
            *energy += 0.5 * (mass * square(velocity[k]) + inertia * square(spin[k]));
        }
    }
    let elastic = |k: usize| {
        let parts = [("F2", 30.0), ("F3", 4.0), ("F4", 15.0)];
        let parts = parts.map(|(name, stiffness)| {
            let x = results.get(&format!("REQUEST_1.{name}")).unwrap()[k];
            0.5 * stiffness * x * x
        });
        parts.iter().sum::<f64>()
    };
    let stored: Vec<f64> = (1..energies.len()).map(elastic).collect();
    let total: Vec<f64> = energies[1..]
        .iter()
        .zip(&stored)
        .map(|(e, s)| e + s)
        .collect();
    for energy in &total {
        // The integrator's error of 1e-9 a step over a thousand steps, of energies of order ten.
        assert!((energy - total[0]).abs() < 1e-5, "{energy} {}", total[0]);
    }
    // Energy goes to and fro.
    assert!(stored.iter().any(|s| (s - stored[0]).abs() > 1.0));
}
