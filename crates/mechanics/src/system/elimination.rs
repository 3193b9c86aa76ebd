//! Which unknowns of the Newton matrix are eliminated together.
//!
//! A body and the multipliers of the constraints towards its parent, in a spanning forest of the
//! mechanism that grows from ground, make `[M −Gᵀ; G 0]`, which is regular wherever the body has mass,
//! as the equations of one joint are independent in the motion of either of its bodies. Multipliers
//! that close a loop, or belong to functions, have no such block: they wait for the last body around.

use std::collections::VecDeque;

use super::System;

/// What a body hangs on in the forest.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Parent {
    Ground,
    Body(usize),
    /// Nothing: it is the root of a tree that floats.
    None,
}

impl System {
    /// The group of every unknown, as `numerics::linear::FrontalLu` takes them.
    pub(crate) fn elimination_groups(&self) -> Vec<Option<u32>> {
        let group = |place: usize| Some(place as u32);
        let bodies = self.model.bodies.len();
        let (states, algebraics) = (self.model.states.len(), self.model.algebraics.len());
        let mut groups = Vec::with_capacity(self.unknown_count());
        groups.extend((0..6 * bodies).map(|motion| group(motion / 6)));
        groups.extend((bodies..bodies + states).map(group));
        groups.extend(self.bodies_of_rows());
        groups.extend((bodies + states..bodies + states + algebraics).map(group));
        groups.extend(self.sharing_groups());
        groups
    }

    /// The body that each constraint equation in force is eliminated with, where one hangs on it.
    pub(crate) fn bodies_of_rows(&self) -> Vec<Option<u32>> {
        self.bodies_of(self.rows.iter())
    }

    /// The body that each of some constraint equations would be eliminated with.
    pub(super) fn bodies_of<'a>(
        &self,
        places: impl Iterator<Item = &'a usize>,
    ) -> Vec<Option<u32>> {
        let parents = self.parents();
        let hanging = |&place: &usize| match self.constraints[place].bodies[..] {
            [body] if parents[body] == Parent::Ground => Some(body as u32),
            [a, b] if parents[a] == Parent::Body(b) => Some(a as u32),
            [a, b] if parents[b] == Parent::Body(a) => Some(b as u32),
            _ => None,
        };
        places.map(hanging).collect()
    }

    /// A spanning forest, breadth first, so that loops close half way around.
    fn parents(&self) -> Vec<Parent> {
        let bodies = self.model.bodies.len();
        let mut joined = vec![Vec::new(); bodies];
        let mut parents = vec![None; bodies];
        let mut open = VecDeque::new();
        for &place in &self.rows {
            match self.constraints[place].bodies[..] {
                [body] if parents[body].is_none() => {
                    parents[body] = Some(Parent::Ground);
                    open.push_back(body);
                }
                [a, b] => {
                    joined[a].push(b);
                    joined[b].push(a);
                }
                _ => {}
            }
        }
        for root in 0..bodies {
            while let Some(body) = open.pop_front() {
                for &other in &joined[body] {
                    if parents[other].is_none() {
                        parents[other] = Some(Parent::Body(body));
                        open.push_back(other);
                    }
                }
            }
            if parents[root].is_none() {
                parents[root] = Some(Parent::None);
                open.push_back(root);
            }
        }
        parents
            .into_iter()
            .map(|parent| parent.unwrap_or(Parent::None))
            .collect()
    }
}
