use crate::run::{run, shared};
use crate::table::{Table, distance};
#[test]
fn debug() {
    let reference = Table::from_csv(
        &std::fs::read_to_string(
            shared("adams-results/delta-robot-friction/delta_robot_reference.csv").unwrap(),
        )
        .unwrap(),
    );
    let commands = shared("adams-results/delta-robot-friction/delta_robot_replay.acf").unwrap();
    for (e, c) in [(1e-6, ""), (1e-8, ""), (1e-8, "si2"), (1e-9, "si2")] {
        let t = std::time::Instant::now();
        let ch: Vec<&str> = if c == "si2" {
            vec!["INTEGRATOR/SI2"]
        } else {
            vec![]
        };
        let ours = Table::from_results(&run(&commands, Some(e), &ch));
        println!("{e:e} {c} {:?}", t.elapsed());
        for row in [
            1, 3, 5, 8, 10, 15, 20, 30, 40, 60, 80, 100, 120, 140, 160, 180, 199,
        ] {
            let mut w = (0.0, 0);
            for part in 2..=11 {
                let d = distance(
                    ours.vector(row, &format!("Part/{part}."), ["X", "Y", "Z"]),
                    reference.vector(row + 1, &format!("P{part}_"), ["X", "Y", "Z"]),
                );
                if d > w.0 {
                    w = (d, part);
                }
            }
            let mut cw = (0.0, 0);
            for j in 18..=29 {
                let f = [
                    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 3, 4, 5, 6, 7, 12, 11,
                    10, 9, 1, 8,
                ][j];
                let a = ours.vector(
                    row,
                    &format!("Friction/{f}."),
                    ["CREEP_AX", "CREEP_AY", "CREEP_AZ"],
                );
                let b = reference.vector(row + 1, &format!("CREEP_J{j}_"), ["X", "Y", "Z"]);
                let d = distance(a, b);
                if d > cw.0 {
                    cw = (d, j);
                }
            }
            println!(
                "  row {row}: {:.2e} part {}   creep {:.2e} J{}",
                w.0, w.1, cw.0, cw.1
            );
        }
    }
}
