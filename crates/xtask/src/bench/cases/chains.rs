//! Chains in space.

use std::path::Path;

use mechanics::Simulation;
use mechanisms::builder::v;
use mechanisms::chains;

use super::assembled;
use crate::bench::case::{Case, PeerSetup, Reference};

/// Rate of the first hinge, which is the first rod's about z, and the end of the chain.
fn ends(simulation: &Simulation) -> Vec<f64> {
    let state = simulation.state();
    let last = state.bodies() - 1;
    let tip = state.centre(last) + state.orientation(last).matrix() * v(0.5, 0.0, 0.0);
    vec![state.velocities()[5], tip.x, tip.y, tip.z]
}

fn chain(
    name: &'static str,
    title: &'static str,
    count: usize,
    [tightest, own]: [i32; 2],
    exudyn: &'static [u32],
    mujoco: &'static [u32],
) -> Result<Case, String> {
    let peer = |name, script, steps| PeerSetup {
        name,
        script,
        arguments: vec![count.to_string()],
        steps,
    };
    Ok(Case {
        name,
        title,
        description: "Rods of 1 m on hinges about z and y by turns fall from the horizontal for 1 s. Joint \
                      coordinates, which need no constraints here, are the ceiling for open chains.",
        simulation: assembled(chains::chain(count).model)?,
        end: 1.0,
        read: ends,
        quantity: "largest of the first hinge's rate, rad/s, and the coordinates of the tip, m, at the end",
        reference: Reference::Own(10f64.powi(own)),
        tightest,
        peers: vec![
            peer(
                "Exudyn, generalised alpha 0.8, absolute coordinates",
                "exudyn_chain.py",
                exudyn,
            ),
            peer(
                "MuJoCo, Runge and Kutta, joint coordinates",
                "mujoco_chain.py",
                mujoco,
            ),
        ],
    })
}

pub(super) fn chain_10(_: &Path) -> Result<Case, String> {
    let exudyn: &[u32] = &[200, 1_000, 5_000];
    chain(
        "chain-10",
        "Chain of 10 rods",
        10,
        [-10, -12],
        exudyn,
        &[20, 50, 100, 300, 1_000],
    )
}

pub(super) fn chain_100(_: &Path) -> Result<Case, String> {
    let exudyn: &[u32] = &[200, 1_000, 2_000];
    chain(
        "chain-100",
        "Chain of 100 rods",
        100,
        [-8, -10],
        exudyn,
        &[20, 50, 100, 300, 1_000],
    )
}

pub(super) fn chain_1000(_: &Path) -> Result<Case, String> {
    let exudyn: &[u32] = &[200, 1_000];
    chain(
        "chain-1000",
        "Chain of 1,000 rods",
        1_000,
        [-8, -9],
        exudyn,
        &[50, 100],
    )
}
