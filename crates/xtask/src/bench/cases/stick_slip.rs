//! LuGre friction: a pendulum on its pin, a block drawn by a spring.

use std::path::Path;

use friction::LuGre;
use mechanisms::turning::Pendulum;

use super::{assembled, reference};
use crate::bench::case::{Case, PeerSetup, Reference};

pub(super) fn lugre_pendulum(_: &Path) -> Result<Case, String> {
    let pendulum = Pendulum {
        length: 0.5,
        pin_radius: 0.05,
        inertia: 1.0 / 12.0,
        gravity: 9.81,
        angle: std::f64::consts::FRAC_PI_2,
        rate: 0.0,
        law: LuGre {
            mu_static: 0.3,
            mu_dynamic: 0.2,
            bristle_stiffness: 1e5,
            damping: 100.0,
            viscous: 0.0,
            stribeck_velocity: 5e-3,
            stribeck_exponent: 2.0,
        }
        .into(),
    };
    Ok(Case {
        name: "lugre-pendulum",
        title: "Pendulum with LuGre friction in its pin",
        description: "A rod of 1 m swings from the horizontal for 5 s on a pin of 50 mm radius whose LuGre \
                      friction follows the reaction. Exudyn has it by user functions in Python, which are \
                      most of its time.",
        simulation: assembled(pendulum.model())?,
        end: 5.0,
        read: |simulation| {
            let m = simulation.state().orientation(0).matrix();
            vec![m[(1, 0)].atan2(m[(0, 0)])]
        },
        quantity: "angle at the end, rad",
        reference: Reference::Own(1e-12),
        tightest: -10,
        peers: vec![PeerSetup {
            name: "Exudyn, trapezoidal index 2",
            script: "exudyn_lugre_pendulum.py",
            arguments: Vec::new(),
            steps: &[500, 2_000, 5_000],
        }],
    })
}

pub(super) fn stick_slip(_: &Path) -> Result<Case, String> {
    let law = LuGre {
        mu_static: 1.5,
        mu_dynamic: 1.0,
        bristle_stiffness: 1e5,
        damping: 1e5_f64.sqrt(),
        viscous: 0.4,
        stribeck_velocity: 1e-3,
        stribeck_exponent: 2.0,
    };
    let exudyn = |name, method: &str, steps| PeerSetup {
        name,
        script: "exudyn_stick_slip.py",
        arguments: vec![method.into()],
        steps,
    };
    Ok(Case {
        name: "stick-slip",
        title: "Stick and slip with LuGre friction",
        description: "A block of 1 kg is drawn by a spring of 2 N/m at 0.1 m/s for 25 s and slips three \
                      times (Canudas de Wit and others, 1995). Ours is a body in space on a translational \
                      joint; Exudyn's is one coordinate with a user function in Python.",
        simulation: assembled(mechanisms::drawn_block(law))?,
        end: 25.0,
        read: |simulation| vec![simulation.state().centre(0).x],
        quantity: "place at the end, m",
        reference: reference(
            "validation/data/A08_cdw_stick_slip.json",
            &["/x25"],
            "integrated to 1e-12 by an independent code",
            1e-12,
        ),
        tightest: -10,
        peers: vec![
            exudyn(
                "Exudyn, trapezoidal index 2",
                "trapezoidal",
                &[10_000, 25_000, 100_000],
            ),
            exudyn("Exudyn, DOPRI5", "dopri5", &[25_000]),
        ],
    })
}
