//! The order in which groups of unknowns are eliminated.

use std::collections::{BTreeMap, BTreeSet};

/// Groups and those that they are coupled with.
#[derive(Clone, Debug)]
pub(super) struct Graph {
    /// By group: the groups around it, and how many of their unknowns it is coupled with.
    around: Vec<BTreeMap<u32, u32>>,
}

impl Graph {
    /// So many groups that are not coupled.
    pub(super) fn new(groups: usize) -> Self {
        Self {
            around: vec![BTreeMap::new(); groups],
        }
    }

    /// Couples group `a` with so many unknowns of group `b`, and `b` with `a`.
    pub(super) fn couple(&mut self, a: u32, b: u32, unknowns: u32) {
        if a != b {
            *self.around[a as usize].entry(b).or_default() += unknowns;
            self.around[b as usize].entry(a).or_default();
        }
    }

    /// All groups by minimum degree (Tinney and Walker, *Direct solutions of sparse network equations
    /// by optimally ordered triangular factorization*, Proc. IEEE 55, 1967): the one that is coupled
    /// with the fewest unknowns first, whose neighbours are then coupled with one another. Trees are
    /// eliminated from their leaves.
    pub(super) fn minimum_degree(mut self) -> Vec<u32> {
        let degree = |around: &BTreeMap<u32, u32>| around.values().map(|&n| u64::from(n)).sum();
        let mut degrees: Vec<u64> = self.around.iter().map(degree).collect();
        let mut queue: BTreeSet<(u64, u32)> = degrees.iter().copied().zip(0..).collect();
        let mut order = Vec::with_capacity(self.around.len());
        while let Some((_, group)) = queue.pop_first() {
            order.push(group);
            let around = std::mem::take(&mut self.around[group as usize]);
            for &a in around.keys() {
                let of_a = &mut self.around[a as usize];
                let mut degree = degrees[a as usize];
                degree -= of_a.remove(&group).map_or(0, u64::from);
                for (&b, &unknowns) in around.iter().filter(|(b, _)| **b != a) {
                    // Those of both couplings together are at least the more of the two.
                    let present = of_a.entry(b).or_default();
                    degree += u64::from(unknowns.saturating_sub(*present));
                    *present = unknowns.max(*present);
                }
                queue.remove(&(degrees[a as usize], a));
                queue.insert((degree, a));
                degrees[a as usize] = degree;
            }
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::Graph;

    #[test]
    fn a_star_is_eliminated_before_its_centre() {
        let mut star = Graph::new(6);
        for leaf in 1..6 {
            star.couple(0, leaf, 1);
            star.couple(leaf, 0, 1);
        }
        let order = star.minimum_degree();
        // Beside the last leaf the centre has the same degree.
        assert!(order[4..].contains(&0), "{order:?}");
    }

    #[test]
    fn a_chain_is_eliminated_from_the_end_that_is_coupled_least() {
        let mut chain = Graph::new(5);
        for link in 1..5 {
            chain.couple(link, link - 1, 6);
            chain.couple(link - 1, link, 11);
        }
        assert_eq!(chain.minimum_degree(), [4, 3, 2, 1, 0]);
    }

    #[test]
    fn every_group_of_a_ring_comes_once() {
        let mut ring = Graph::new(7);
        for group in 0..7 {
            ring.couple(group, (group + 1) % 7, 2);
            ring.couple((group + 1) % 7, group, 2);
        }
        let mut order = ring.minimum_degree();
        order.sort_unstable();
        assert_eq!(order, [0, 1, 2, 3, 4, 5, 6]);
    }
}
