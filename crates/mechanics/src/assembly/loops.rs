//! Loops: which constraint equations may depend on one another.
//!
//! Coefficients `c` with `cᵀG = 0` are reactions in balance on every body. What hangs on the rest of the
//! mechanism by a single body is in balance as a whole, so that its reactions on that body are in
//! balance, too, and with them everything on either side. Dependent equations therefore lie in one
//! biconnected component of the graph whose vertices are the bodies and ground and whose edges are the
//! constraint equations: the joint between two branches alone, or a loop with all loops that share a
//! body pair with it. This holds for equations that depend on relative positions alone, whose reactions
//! on the two bodies are in balance. Functions, and equations on a point mass (on which a torque does
//! nothing), may act on ground, too, for that matter.

use crate::constraint::{Constraint, Form};
use crate::system::System;

impl System {
    /// The equations in force by loops: for each loop the rows, ascending.
    pub(super) fn loops(&self) -> Vec<Vec<usize>> {
        let ground = self.model.bodies.len();
        let mut graph = Graph::new(ground + 1);
        let mut ends = Vec::with_capacity(self.rows.len());
        for &place in &self.rows {
            let around = self.acts_on(&self.constraints[place]);
            // A ring of more than two keeps all of them in one component.
            for pair in around.windows(2) {
                graph.join(pair[0], pair[1]);
            }
            if let ([first, .., last], true) = (&around[..], around.len() > 2) {
                graph.join(*first, *last);
            }
            let first = around.first().copied().unwrap_or(ground);
            ends.push([first, around.get(1).copied().unwrap_or(first)]);
        }
        let components = graph.biconnected();
        let mut loops = vec![Vec::new(); components.count];
        for (row, ends) in ends.into_iter().enumerate() {
            match components.of(ends) {
                Some(component) => loops[component].push(row),
                // An equation that acts on nothing depends on no other.
                None => loops.push(vec![row]),
            }
        }
        loops
    }

    /// The bodies that the reaction of a constraint acts on, and ground, which comes after them.
    fn acts_on(&self, constraint: &Constraint) -> Vec<usize> {
        let mut around = constraint.bodies.clone();
        let rotates = |&body: &usize| self.model.bodies[body].rotates;
        let relative = constraint.form != Form::Function && around.iter().all(rotates);
        if around.len() == 1 || !relative {
            around.push(self.model.bodies.len());
        }
        around
    }
}

/// An undirected graph.
struct Graph {
    neighbours: Vec<Vec<usize>>,
}

/// Which biconnected component every edge of a graph belongs to.
struct Components {
    count: usize,
    /// By vertex: when a depth-first search came to it.
    found: Vec<usize>,
    /// By vertex: the component of the edge to its parent in that search.
    above: Vec<usize>,
}

impl Components {
    /// The component of an edge: of that above its end that was found last, from which every edge to an
    /// earlier vertex is part of a cycle through its parent.
    fn of(&self, [a, b]: [usize; 2]) -> Option<usize> {
        let lower = if self.found[a] > self.found[b] { a } else { b };
        (a != b).then(|| self.above[lower])
    }
}

impl Graph {
    fn new(vertices: usize) -> Self {
        Self {
            neighbours: vec![Vec::new(); vertices],
        }
    }

    fn join(&mut self, a: usize, b: usize) {
        self.neighbours[a].push(b);
        self.neighbours[b].push(a);
    }

    /// Hopcroft and Tarjan, *Efficient algorithms for graph manipulation*, Communications of the ACM 16
    /// (1973): an edge to a vertex from whose descendants nothing leads back above the parent ends a
    /// component.
    fn biconnected(&self) -> Components {
        const UNKNOWN: usize = usize::MAX;
        let vertices = self.neighbours.len();
        let mut components = Components {
            count: 0,
            found: vec![UNKNOWN; vertices],
            above: vec![UNKNOWN; vertices],
        };
        let mut parents = vec![UNKNOWN; vertices];
        // The earliest vertex that each reaches by its descendants and one edge back.
        let mut lowest = vec![UNKNOWN; vertices];
        let mut order = Vec::with_capacity(vertices);
        for root in 0..vertices {
            if components.found[root] != UNKNOWN {
                continue;
            }
            components.found[root] = order.len();
            lowest[root] = order.len();
            order.push(root);
            let mut open = vec![(root, 0)];
            while let Some((vertex, next)) = open.pop() {
                let Some(&other) = self.neighbours[vertex].get(next) else {
                    if let Some(&(parent, _)) = open.last() {
                        lowest[parent] = lowest[parent].min(lowest[vertex]);
                    }
                    continue;
                };
                open.push((vertex, next + 1));
                if components.found[other] == UNKNOWN {
                    components.found[other] = order.len();
                    lowest[other] = order.len();
                    parents[other] = vertex;
                    order.push(other);
                    open.push((other, 0));
                } else if other != parents[vertex] {
                    lowest[vertex] = lowest[vertex].min(components.found[other]);
                }
            }
        }
        // From the roots down: a vertex whose descendants reach above its parent is in the parent's.
        for &vertex in &order {
            let parent = parents[vertex];
            if parent == UNKNOWN {
                continue;
            }
            components.above[vertex] = if lowest[vertex] < components.found[parent] {
                components.above[parent]
            } else {
                components.count += 1;
                components.count - 1
            };
        }
        components
    }
}

#[cfg(test)]
mod tests {
    use super::Graph;

    /// Components of the edges, by their first edge.
    fn components(vertices: usize, edges: &[[usize; 2]]) -> Vec<usize> {
        let mut graph = Graph::new(vertices);
        edges.iter().for_each(|&[a, b]| graph.join(a, b));
        let components = graph.biconnected();
        let of = |edge: &[usize; 2]| components.of(*edge).unwrap();
        let first = |edge| {
            edges
                .iter()
                .position(|other| of(other) == of(edge))
                .unwrap()
        };
        edges.iter().map(first).collect()
    }

    #[test]
    fn branches_are_apart_and_loops_together() {
        // A triangle, a tail of two edges, a double edge at its end, and a square on the triangle.
        let edges = [
            [0, 1],
            [1, 2],
            [2, 0],
            [2, 3],
            [3, 4],
            [4, 5],
            [5, 4],
            [1, 6],
            [6, 7],
            [7, 2],
        ];
        assert_eq!(components(8, &edges), [0, 0, 0, 3, 4, 5, 5, 0, 0, 0]);
    }

    #[test]
    fn loops_that_share_one_body_are_apart() {
        let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2]];
        assert_eq!(components(5, &edges), [0, 0, 0, 3, 3, 3]);
    }

    #[test]
    fn random_graphs_fall_apart_where_a_vertex_is_taken_out() {
        // Two edges at a vertex are in one component just if their other ends are connected, or the
        // same, without that vertex.
        let mut seed = 1_u64;
        let mut below = |end: usize| {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1);
            (seed >> 33) as usize % end
        };
        for _ in 0..200 {
            let vertices = 2 + below(9);
            let mut edges = Vec::new();
            for _ in 0..below(14) {
                let edge = [below(vertices), below(vertices)];
                if edge[0] != edge[1] {
                    edges.push(edge);
                }
            }
            let component = components(vertices, &edges);
            for (k, a) in edges.iter().enumerate() {
                for (l, b) in edges.iter().enumerate() {
                    let shared = a.iter().find(|vertex| b.contains(vertex));
                    let Some(&cut) = shared.filter(|_| k != l) else {
                        continue;
                    };
                    let end = |edge: &[usize; 2]| edge[usize::from(edge[0] == cut)];
                    let mut reached = vec![end(a)];
                    let mut next = 0;
                    while let Some(&at) = reached.get(next) {
                        next += 1;
                        for edge in edges
                            .iter()
                            .filter(|e| e.contains(&at) && !e.contains(&cut))
                        {
                            let other = edge[usize::from(edge[0] == at)];
                            if !reached.contains(&other) {
                                reached.push(other);
                            }
                        }
                    }
                    let together = component[k] == component[l];
                    assert_eq!(
                        together,
                        reached.contains(&end(b)),
                        "{a:?} {b:?} of {edges:?}"
                    );
                }
            }
        }
    }
}
