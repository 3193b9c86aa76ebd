//! Machines without friction against real Adams results: positions, reactions and measures.

use crate::shared::run_dynamic;
use crate::table::{Table, distance, norm};

/// Largest difference of the positions of the parts, and of joint reactions relative to their peak.
fn compare(name: &str, parts: &[u32], joints: &[u32], error: f64) -> Option<[f64; 2]> {
    let dataset = reference_data::path(&format!("adams-results/{name}.adm"))?;
    let real = reference_data::path(&format!("adams-results/{name}.res"))?;
    let real = Table::from_results(&results::ResFile::read(real).unwrap());
    let end = *real.times.last().unwrap();
    let steps = u32::try_from(real.times.len()).unwrap();
    let ours = Table::from_results(&run_dynamic(&dataset, end, steps, Some(error)));
    assert_eq!(ours.rows.len(), real.rows.len());
    let (mut position, mut force, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64);
    for row in 0..real.rows.len() {
        let pair = |kind: &str, id: &u32, endings| {
            let name = format!("{kind}/{id}.");
            (
                ours.vector(row, &name, endings),
                real.vector(row, &name, endings),
            )
        };
        for part in parts {
            let (a, b) = pair("Part", part, ["X", "Y", "Z"]);
            position = position.max(distance(a, b));
        }
        for joint in joints {
            let (a, b) = pair("Joint", joint, ["FX", "FY", "FZ"]);
            force = force.max(distance(a, b));
            peak = peak.max(norm(b));
        }
    }
    let relative = if peak > 0.0 { force / peak } else { force };
    println!(
        "{name}, error {error:e}: positions {position:.2e}, reactions {relative:.2e} of their peak {peak:.3e}"
    );
    Some([position, relative])
}

#[test]
fn cart_with_inverted_pendulum() {
    // Millimetres. Adams ran GSTIFF at its default error of 1e-3 over five swings of a pendulum
    // that passes its upright position, so differences grow; ours falls with the error until
    // Adams' own remains.
    let name = "cart-pendulum/cart_pendulum";
    let Some([loose, _]) = compare(name, &[2, 3], &[1, 2], 1e-4) else {
        return;
    };
    let Some([tight, force]) = compare(name, &[2, 3], &[1, 2], 1e-8) else {
        return;
    };
    assert!(tight < loose && tight < 1.0 && force < 2e-2);
}

#[test]
fn mechanisms_with_redundant_constraints() {
    // Four mechanisms at rest without weight: what is compared is their assembly with redundant
    // constraints, to the ten digits of their datasets.
    for machine in 1..=4 {
        let name = format!("solidworks-motion/adams{machine}");
        let joints: Vec<u32> = (1..=11).collect();
        let Some([position, force]) = compare(&name, &[2, 3, 4, 5, 6], &joints, 1e-6) else {
            return;
        };
        assert!(position < 1e-9 && force < 1e-9);
    }
}
