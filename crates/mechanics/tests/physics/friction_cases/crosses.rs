//! Shafts coupled by a cross with friction in its pins (B09).

use friction::parameters::JointType;
use mechanics::{Formulation, Owner};
use verification::{Case, Section, check};

use super::original;
use crate::runs::{run, settings};
use crate::shared::{number, reference, table};
use mechanisms::{Cross, law, shafts};

#[test]
fn work_of_a_cross_per_turn() {
    let Some(file) = reference("validation/data/B09_hooke.json") else {
        return;
    };
    let mut claims = Vec::new();
    for (cross, joint, name) in [
        (Cross::Hooke, JointType::Hooke, "hooke"),
        (Cross::Universal, JointType::Universal, "universal"),
    ] {
        for (pins, [i, j], work) in [
            ("both pins", [true, true], "(1, 1)"),
            ("pin of I", [true, false], "(1, 0)"),
            ("pin of J", [false, true], "(0, 1)"),
            ("no friction", [false, false], "(0, 0)"),
        ] {
            // Pins slip at up to 0.06 m/s; none is slow at the angles of the table.
            let law = law(0.1, 0.1, 1e-5, 1e-7);
            let laws = [i, j].map(|on| on.then_some(law));
            let arguments: &[&str] = match (i, j) {
                (true, true) => &["I_YOKE", "J_YOKE", "PIN_RADIUS", "BENDING_REACTION_ARM"],
                (true, false) => &["I_YOKE"],
                (false, true) => &["J_YOKE"],
                (false, false) => &[],
            };
            let covers = original(joint, arguments);
            let case = Case {
                section: Section::Joint,
                id: &format!("B09 {name}, {pins}"),
                model: "shafts at 30°, input at 10 rad/s, load 5 N m, pins of 0.01 m, Rb 0.04 m, μ 0.1",
                source: "statics of the cross, closed form of its pins' rates; quadrature of the work",
                covers: if i || j { &covers } else { &[] },
            };
            let settings = settings(Formulation::Si2, 1e-9, 0.01);
            let file_name = format!(
                "validation/data/B09_hooke_yokes_{}{}.csv",
                u8::from(i),
                u8::from(j)
            );
            if let Some(rows) = reference_data::path(&file_name).map(table) {
                let times: Vec<f64> = rows.iter().map(|row| row[0] / 10.0).collect();
                let [mut torque, mut rate] = [const { Vec::new() }; 2];
                run(shafts(cross, laws), &times, &settings, |s| {
                    torque.push(s.reaction(Owner::Motion(0)).torque.z);
                    let axis = s.marker(5).axis(2);
                    rate.push(s.marker(4).omega.dot(&axis));
                });
                let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
                let why = "the error of the integrator and the inertia of 1e-12 kg m²";
                claims.push(case.values(
                    "torque at 24 angles [N m]",
                    &torque,
                    &column(7),
                    1e-9,
                    why,
                ));
                claims.push(case.values(
                    "rate of the output there [rad/s]",
                    &rate,
                    &column(1),
                    1e-9,
                    why,
                ));
            }
            let turn = std::f64::consts::TAU / 10.0;
            let settings = mechanics::Settings {
                longest_step: 1e-3,
                ..settings
            };
            let end = run(shafts(cross, laws), &[turn], &settings, |_| {});
            let ours = *end.state().works().last().expect("the work of motions");
            let exact = number(&file, &format!("/cases/work_in_per_rev/{work}"));
            let why = "pins below Vs = 1e-5 m/s of 0.06 m/s; shafts without mass leave reactions to Newton's tolerance";
            claims.push(case.values("work of a turn [J]", &[ours], &[exact], 5e-5, why));
        }
    }
    check(&claims);
}
