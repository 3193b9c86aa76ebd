//! The frontal LU against the dense one, on matrices with the structure of mechanisms.

use super::dense::DenseLu;
use super::{FrontalLu, Matrix};

/// A small deterministic generator; the numbers only have to differ.
struct Numbers(u64);

impl Numbers {
    /// Between -0.5 and 0.5.
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    fn below(&mut self, end: usize) -> usize {
        ((self.next() + 0.5) * end as f64) as usize
    }
}

/// Equations between two bodies, or a body and ground.
struct Joint {
    bodies: Vec<usize>,
    rows: usize,
}

/// Bodies of six unknowns in a random tree of joints, with loops, springs and friction.
struct Mechanism {
    masses: Vec<f64>,
    /// The joint of every body towards ground, and then those that close loops.
    joints: Vec<Joint>,
    springs: Vec<[usize; 2]>,
}

impl Mechanism {
    fn random(bodies: usize, numbers: &mut Numbers) -> Self {
        let mut joints: Vec<Joint> = (0..bodies)
            .map(|body| {
                let near = body.saturating_sub(1 + numbers.below(4));
                let bodies = if body == 0 || numbers.below(8) == 0 {
                    vec![body]
                } else {
                    vec![body, near]
                };
                let rows = 3 + numbers.below(3);
                Joint { bodies, rows }
            })
            .collect();
        for _ in 0..numbers.below(1 + bodies / 3) {
            let first = numbers.below(bodies);
            let last = (first + 1 + numbers.below(6)) % bodies;
            if first != last {
                let rows = 1 + numbers.below(2);
                let bodies = vec![first, last];
                joints.push(Joint { bodies, rows });
            }
        }
        // Bodies without mass, too, that only springs or other bodies hold.
        let mut mass = || match numbers.below(10) {
            0 => 0.0,
            k => 10.0_f64.powi(k as i32 % 3 - 1),
        };
        let masses = (0..bodies).map(|_| mass()).collect();
        let springs = (0..bodies / 4).map(|_| [numbers.below(bodies), numbers.below(bodies)]);
        let springs = springs.filter(|[a, b]| a != b).collect();
        Self {
            masses,
            joints,
            springs,
        }
    }

    fn size(&self) -> usize {
        6 * self.masses.len() + self.joints.iter().map(|joint| joint.rows).sum::<usize>()
    }

    fn groups(&self) -> Vec<Option<u32>> {
        let bodies = self.masses.len();
        let mut groups: Vec<_> = (0..6 * bodies).map(|k| Some(k as u32 / 6)).collect();
        for (place, joint) in self.joints.iter().enumerate() {
            let group = (place < bodies).then_some(place as u32);
            groups.resize(groups.len() + joint.rows, group);
        }
        groups
    }

    /// `[M + K, −Gᵀ − F; G, 0]` with random blocks, zeros where a random entry is no friction.
    fn fill(&self, matrix: &mut Matrix, numbers: &mut Numbers) {
        matrix.start();
        for (body, mass) in self.masses.iter().enumerate() {
            for r in 0..6 {
                for c in 0..6 {
                    let own = if r == c { 1.0 } else { 0.1 * numbers.next() };
                    matrix.add(6 * body + r, 6 * body + c, mass * own);
                }
            }
        }
        for spring in &self.springs {
            for a in spring {
                for b in spring {
                    for r in 0..6 {
                        for c in 0..6 {
                            matrix.add(6 * a + r, 6 * b + c, numbers.next());
                        }
                    }
                }
            }
        }
        let mut row = 6 * self.masses.len();
        for joint in &self.joints {
            for _ in 0..joint.rows {
                for &body in &joint.bodies {
                    for k in 0..6 {
                        let g = numbers.next();
                        let friction = if k == 5 { 0.3 * numbers.next() } else { 0.0 };
                        matrix.add(row, 6 * body + k, g);
                        matrix.add(6 * body + k, row, friction - g);
                    }
                }
                row += 1;
            }
        }
        matrix.compress();
    }
}

/// The largest `|A x − b|` relative to `|A| |x| + |b|` (Oettli and Prager): how much entries would have
/// to change for `x` to be exact.
fn backward_error(matrix: &Matrix, x: &[f64], b: &[f64]) -> f64 {
    let mut worst = 0.0_f64;
    for row in 0..matrix.size() {
        let (mut rest, mut size) = (-b[row], b[row].abs());
        for k in matrix.row_starts()[row]..matrix.row_starts()[row + 1] {
            let product = matrix.values()[k] * x[matrix.columns()[k] as usize];
            rest += product;
            size += product.abs();
        }
        worst = worst.max(rest.abs() / size.max(1e-300));
    }
    worst
}

fn random_right(size: usize, numbers: &mut Numbers) -> Vec<f64> {
    (0..size).map(|_| numbers.next()).collect()
}

/// What factorisations of mechanisms came to.
#[derive(Default)]
struct Comparison {
    /// Matrices that the dense oracle solves well.
    solved: usize,
    /// Pivots that were delayed in these.
    delayed: usize,
    /// The largest backward error.
    worst: f64,
}

/// Solves with these groups what the dense oracle solves.
fn compare(
    mechanism: &Mechanism,
    groups: Vec<Option<u32>>,
    numbers: &mut Numbers,
    all: &mut Comparison,
) {
    let size = mechanism.size();
    let mut matrix = Matrix::new(size);
    let mut lu = FrontalLu::new(groups);
    for _ in 0..3 {
        mechanism.fill(&mut matrix, numbers);
        let b = random_right(size, numbers);
        let (mut x, mut exact) = (b.clone(), b.clone());
        let mut dense = DenseLu::new(size);
        if dense.factor(&matrix.to_dense()).is_err() {
            continue;
        }
        dense.solve(&mut exact);
        if backward_error(&matrix, &exact, &b) > 1e-13 {
            // Nearly singular, as bodies without mass make it now and then.
            continue;
        }
        lu.factor(&matrix).unwrap();
        lu.solve(&mut x);
        all.solved += 1;
        all.delayed += lu.delayed();
        all.worst = all.worst.max(backward_error(&matrix, &x, &b));
    }
}

#[test]
fn random_mechanisms_are_solved_as_well_as_by_the_dense_oracle() {
    let mut numbers = Numbers(1);
    let mut all = Comparison::default();
    for case in 0..200 {
        let mechanism = Mechanism::random(1 + case % 25, &mut numbers);
        compare(&mechanism, mechanism.groups(), &mut numbers, &mut all);
    }
    let (solved, delayed, worst) = (all.solved, all.delayed, all.worst);
    println!("{solved} of 600 solved, {delayed} pivots delayed, backward error {worst:e}");
    assert!(solved > 300, "{solved}");
    assert!(delayed > 0, "bodies without mass must delay pivots");
    // Multipliers up to a thousand let rounding grow by that much, and more over several fronts.
    assert!(worst <= 1e-12, "{worst:e}");
}

#[test]
fn any_groups_give_the_solution() {
    let mut numbers = Numbers(2);
    let mut all = Comparison::default();
    for case in 0..100 {
        let mechanism = Mechanism::random(1 + case % 12, &mut numbers);
        // Multipliers without a body, whose block on the diagonal is zero, among them.
        let mut group = |_| (numbers.below(5) > 0).then(|| numbers.below(20) as u32);
        let groups = (0..mechanism.size()).map(&mut group).collect();
        compare(&mechanism, groups, &mut numbers, &mut all);
    }
    let (delayed, worst) = (all.delayed, all.worst);
    println!("{delayed} pivots delayed, backward error {worst:e}");
    assert!(delayed > 1000, "{delayed}");
    // Blocks that are far from regular make larger multipliers than those of mechanisms.
    assert!(worst <= 1e-10, "{worst:e}");
}

#[test]
fn repeated_factorisations_give_the_same_bits() {
    let mut numbers = Numbers(3);
    let mechanism = Mechanism {
        masses: vec![1.0; 20],
        ..Mechanism::random(20, &mut numbers)
    };
    let mut matrices = [0; 2].map(|_| Matrix::new(mechanism.size()));
    matrices
        .iter_mut()
        .for_each(|matrix| mechanism.fill(matrix, &mut numbers));
    let b = random_right(mechanism.size(), &mut numbers);
    let mut lu = FrontalLu::new(mechanism.groups());
    let mut solve = |matrix: &Matrix| {
        lu.factor(matrix).unwrap();
        let mut x = b.clone();
        lu.solve(&mut x);
        x.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    let first = solve(&matrices[0]);
    assert_ne!(solve(&matrices[1]), first);
    assert_eq!(solve(&matrices[0]), first);
}

/// A chain of bodies from ground with five equations a joint.
fn chain(bodies: usize) -> Mechanism {
    let bodies_of = |body| {
        if body == 0 {
            vec![0]
        } else {
            vec![body, body - 1]
        }
    };
    let joint = |body| Joint {
        bodies: bodies_of(body),
        rows: 5,
    };
    Mechanism {
        masses: vec![1.0; bodies],
        joints: (0..bodies).map(joint).collect(),
        springs: Vec::new(),
    }
}

#[test]
fn factors_grow_linearly_with_a_chain() {
    let fill = |bodies: usize| {
        let mechanism = chain(bodies);
        let mut matrix = Matrix::new(mechanism.size());
        mechanism.fill(&mut matrix, &mut Numbers(4));
        let mut lu = FrontalLu::new(mechanism.groups());
        lu.factor(&matrix).unwrap();
        lu.fill()
    };
    // Eleven pivots over a border of the six unknowns of the next body.
    assert!(fill(400) <= 400 * (17 * 17 - 6 * 6), "{}", fill(400));
    assert!(fill(800) <= 2 * fill(400) + 17 * 17);
}

#[test]
fn equations_that_depend_on_one_another_are_named() {
    let mut numbers = Numbers(5);
    let mut mechanism = chain(12);
    // A second joint beside that of body 7: what they say twice is the only dependency.
    let twice = mechanism.joints[7].bodies.clone();
    mechanism.joints.push(Joint {
        bodies: twice,
        rows: 1,
    });
    let size = mechanism.size();
    let (first, second) = (6 * 12 + 5 * 7, size - 1);
    let mut matrix = Matrix::new(size);
    mechanism.fill(&mut matrix, &mut numbers);
    let full = matrix.to_dense();
    let mut twice = Matrix::new(size);
    twice.start();
    let same = |place: usize| if place == second { first } else { place };
    for row in 0..size {
        for k in matrix.row_starts()[row]..matrix.row_starts()[row + 1] {
            let column = matrix.columns()[k] as usize;
            twice.add(row, column, full[same(row) * size + same(column)]);
        }
    }
    twice.compress();
    let mut lu = FrontalLu::new(mechanism.groups());
    let error = lu.factor(&twice).unwrap_err();
    assert!([first, second].contains(&error.row), "{error}");
    assert!([first, second].contains(&error.column), "{error}");
    // The same storage serves where they are independent again.
    lu.factor(&matrix).unwrap();
}

#[test]
fn what_is_not_a_number_is_singular_not_a_result() {
    for value in [f64::NAN, f64::INFINITY, 0.0] {
        let mut matrix = Matrix::new(6);
        matrix.start();
        for k in 0..6 {
            matrix.add(k, k, 1.0);
            matrix.add(5, k, value);
        }
        matrix.add(5, 5, -1.0);
        matrix.compress();
        let error = FrontalLu::new(vec![Some(0); 6]).factor(&matrix);
        assert_eq!(error.unwrap_err().row, 5, "{value}");
    }
}
