//! Linkages: Andrews' mechanism, rows of four-bars, slider-crank, Bricard's mechanism, governor.

use std::path::Path;

use mechanics::Simulation;
use mechanisms::builder::v;

use super::{assembled, known, reference};
use crate::bench::case::{Case, PeerSetup, Reference};

/// Angle of a body about z, in the turn that is nearest to `near`.
fn angle_near(simulation: &Simulation, body: usize, start: f64, near: f64) -> f64 {
    let m = simulation.state().orientation(body).matrix();
    let angle = start + m[(1, 0)].atan2(m[(0, 0)]);
    let turn = std::f64::consts::TAU;
    angle + turn * ((near - angle) / turn).round()
}

/// Angles of the bodies of Andrews' mechanism after 0.05 s, to the nearest turn.
const ANDREWS_END: [f64; 7] = [33.8, 0.2, 0.1, 0.1, 0.5, 1.5, 1.1];

fn andrews_angles(simulation: &Simulation) -> Vec<f64> {
    let start = mechanisms::andrews().angles;
    let angle = |body| angle_near(simulation, body, start[body], ANDREWS_END[body]);
    (0..7).map(angle).collect()
}

pub(super) fn andrews(_: &Path) -> Result<Case, String> {
    let file = "validation/data/D01_D03_ivp_testset.json";
    let reference = match known(file, &["/andrews/q_005"]) {
        Some(q) if q.len() == 7 => Reference::Known {
            values: mechanisms::body_angles(&q).to_vec(),
            source: "minimal coordinates integrated to 1e-13 by an independent code",
        },
        _ => Reference::Own(1e-12),
    };
    Ok(Case {
        name: "andrews",
        title: "Andrews' squeezing mechanism",
        description: "Seven bodies in the plane, three loops, driven at up to 1,100 rad/s for 0.05 s \
                      (IVP test set). Ours has bodies in space and drops nine redundant equations; \
                      Exudyn's has bodies in the plane.",
        simulation: assembled(mechanisms::andrews().model)?,
        end: 0.05,
        read: andrews_angles,
        quantity: "largest of the seven body angles at the end, rad",
        reference,
        tightest: -10,
        peers: vec![
            PeerSetup {
                name: "Exudyn, generalised alpha 0.8",
                script: "exudyn_andrews.py",
                arguments: vec!["alpha".into()],
                steps: &[500, 2_000, 8_000, 16_000, 64_000],
            },
            PeerSetup {
                name: "Exudyn, trapezoidal index 2",
                script: "exudyn_andrews.py",
                arguments: vec!["trapezoidal".into()],
                steps: &[500, 2_000, 8_000, 16_000, 64_000],
            },
        ],
    })
}

/// The head of the first upright.
fn first_head(simulation: &Simulation) -> Vec<f64> {
    let centre = simulation.state().centre(0);
    vec![2.0 * centre.x, 2.0 * centre.y]
}

fn four_bars(
    name: &'static str,
    title: &'static str,
    loops: usize,
    peer: [&'static [u32]; 2],
) -> Result<Case, String> {
    let place = |axis: &str| format!("/cases/A02_N{loops}/{axis}B0_10");
    let exudyn = |name, method: &str, steps| PeerSetup {
        name,
        script: "exudyn_four_bar.py",
        arguments: vec![method.into(), loops.to_string()],
        steps,
    };
    Ok(Case {
        name,
        title,
        description: "Four-bar loops of equal rods side by side (IFToMM A02) for 10 s; twice a turn all \
                      rods are in line, where the mechanism may branch. Ours has bodies in space and \
                      drops redundant equations; Exudyn's has bodies in the plane.",
        simulation: assembled(mechanisms::four_bar_chain(loops))?,
        end: 10.0,
        read: first_head,
        quantity: "larger coordinate of the head of the first upright at the end, m",
        reference: reference(
            "validation/data/D05_D06_benchmarks.json",
            &[&place("x"), &place("y")],
            "its one equation of motion, integrated to 1e-13",
            1e-11,
        ),
        tightest: -10,
        peers: vec![
            exudyn("Exudyn, generalised alpha 0.8", "alpha", peer[0]),
            exudyn("Exudyn, trapezoidal index 2", "trapezoidal", peer[1]),
        ],
    })
}

pub(super) fn four_bar_2(_: &Path) -> Result<Case, String> {
    let steps: &[u32] = &[1_000, 4_000, 10_000, 16_000, 20_000, 64_000];
    four_bars("four-bar-2", "Four-bars, N = 2", 2, [steps, &[4_000]])
}

pub(super) fn four_bar_40(_: &Path) -> Result<Case, String> {
    let steps: &[u32] = &[2_000, 4_000, 10_000];
    four_bars("four-bar-40", "Four-bars, N = 40", 40, [steps, &[2_000]])
}

pub(super) fn slider_crank(_: &Path) -> Result<Case, String> {
    let law = mechanisms::law(0.25, 0.20, 0.01, 1e-4);
    Ok(Case {
        name: "slider-crank",
        title: "Slider-crank with friction in all joints",
        description: "Crank 0.1 m, rod 0.3 m, 20 rad/s at first, for 2 s: it comes to rest and sticks. \
                      ORIGINAL friction of 0.25 and 0.2 from the reactions of three pins and the slider.",
        simulation: assembled(mechanisms::slider_crank_with_pins(Some(law)))?,
        end: 2.0,
        read: |simulation| vec![angle_near(simulation, 0, 0.0, 0.0)],
        quantity: "angle of the crank at the end, rad",
        reference: Reference::Own(1e-11),
        tightest: -9,
        peers: Vec::new(),
    })
}

pub(super) fn bricard(_: &Path) -> Result<Case, String> {
    Ok(Case {
        name: "bricard",
        title: "Bricard's mechanism",
        description: "Five rods and six revolute joints in space that move although there are no fewer \
                      equations than velocities (IFToMM A04), for 10 s; one equation is redundant, another \
                      one in other positions.",
        simulation: assembled(mechanisms::bricard())?,
        end: 10.0,
        read: |simulation| {
            let state = simulation.state();
            let end = state.orientation(2).matrix() * v(0.0, 0.0, 0.5);
            (state.centre(2) + end).iter().copied().collect()
        },
        quantity: "largest coordinate of the point P3 at the end, m",
        reference: reference(
            "validation/data/D07_bricard_ssc.json",
            &["/cases/A04_slender/P3_10s"],
            "integrated to 1e-12 with all 30 equations",
            1e-11,
        ),
        tightest: -10,
        peers: Vec::new(),
    })
}

pub(super) fn governor(_: &Path) -> Result<Case, String> {
    Ok(Case {
        name: "governor",
        title: "Flyball governor",
        description: "Two arms with balls on a turning shaft carry a sleeve by springs of 8e5 N/m and \
                      dampers of 4e4 N s/m: stiff. 5 s from 10 rad/s.",
        simulation: assembled(mechanisms::governor())?,
        end: 5.0,
        read: |simulation| vec![simulation.state().centre(1).y],
        quantity: "height of the sleeve at the end, m",
        reference: Reference::Own(1e-11),
        tightest: -9,
        peers: Vec::new(),
    })
}
