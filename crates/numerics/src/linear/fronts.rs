//! The fronts of an elimination: which unknowns each eliminates, and where everything is added.

use super::Matrix;
use super::ordering::Graph;
use serde::{Deserialize, Serialize};

/// Multiplications that a front costs beside its elimination: what is saved where two are one.
const OVERHEAD: f64 = 400.0;
/// A larger front may cost this much more than the two that it replaces.
const GROWTH: f64 = 1.1;

/// A dense block: the rows and columns of the unknowns that it eliminates, and of those later ones
/// that they are coupled with, its border.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Front {
    /// Number of unknowns eliminated here.
    pub(super) own: usize,
    /// Where its unknowns start in [`Fronts::unknowns`]: own ones, then the border.
    pub(super) first: usize,
    /// Number of unknowns.
    pub(super) size: usize,
    /// Number of fronts that add what they leave to this one.
    pub(super) children: usize,
    /// Range in [`Fronts::entries`].
    pub(super) entries: std::ops::Range<usize>,
}

/// An entry of the matrix and its place in a front.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct Entry {
    /// Place among the values of the matrix.
    pub(super) value: u32,
    /// Column by column, in a front without delayed pivots.
    pub(super) place: u32,
}

/// All fronts, each after its children and these one after the other (postorder).
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Fronts {
    pub(super) fronts: Vec<Front>,
    pub(super) unknowns: Vec<u32>,
    /// For every unknown of a border, in the order of [`Fronts::unknowns`]: its place in the parent.
    pub(super) in_parent: Vec<u32>,
    pub(super) entries: Vec<Entry>,
}

/// A front while the tree is made.
struct Node {
    own: Vec<u32>,
    /// Ascending by step.
    border: Vec<u32>,
    children: Vec<usize>,
}

impl Fronts {
    /// Orders the groups of unknowns of a matrix by minimum degree and finds their fronts.
    ///
    /// `groups` says for every unknown which group it is eliminated with; one without a group goes
    /// with the last of the groups that it is coupled with.
    pub(super) fn new(matrix: &Matrix, groups: &[Option<u32>]) -> Self {
        let coupled = couplings(matrix);
        let nodes = joined(tree(&coupled, &members(&coupled, groups)));
        Self::numbered(matrix, &nodes)
    }

    /// The fronts in postorder with all their places.
    fn numbered(matrix: &Matrix, nodes: &[Node]) -> Self {
        let mut fronts = Self::default();
        let order = postorder(nodes);
        let mut number = vec![0; nodes.len()];
        // Number of the front that eliminates each unknown.
        let mut at = vec![0; matrix.size()];
        for (place, &node) in order.iter().enumerate() {
            number[node] = place;
            for &unknown in &nodes[node].own {
                at[unknown as usize] = place;
            }
        }
        let columns = by_column(matrix);
        let mut local = vec![0_u32; matrix.size()];
        for (place, &node) in order.iter().enumerate() {
            let node = &nodes[node];
            let first = fronts.unknowns.len();
            fronts.unknowns.extend(node.own.iter().chain(&node.border));
            for (k, &unknown) in fronts.unknowns[first..].iter().enumerate() {
                local[unknown as usize] = k as u32;
            }
            let size = (fronts.unknowns.len() - first) as u32;
            let start = fronts.entries.len();
            for &own in &node.own {
                let own = own as usize;
                for k in matrix.row_starts()[own]..matrix.row_starts()[own + 1] {
                    let column = matrix.columns()[k] as usize;
                    if at[column] >= place {
                        fronts.entries.push(Entry {
                            value: k as u32,
                            place: local[column] * size + local[own],
                        });
                    }
                }
                for &(row, k) in &columns[own] {
                    if at[row as usize] > place {
                        fronts.entries.push(Entry {
                            value: k,
                            place: local[own] * size + local[row as usize],
                        });
                    }
                }
            }
            fronts.fronts.push(Front {
                own: node.own.len(),
                first,
                size: size as usize,
                children: node.children.len(),
                entries: start..fronts.entries.len(),
            });
        }
        fronts.place_in_parents(&order, nodes, &number);
        fronts
    }

    fn place_in_parents(&mut self, order: &[usize], nodes: &[Node], number: &[usize]) {
        self.in_parent = vec![0; self.unknowns.len()];
        let mut local = vec![0_u32; self.unknowns.len()];
        for &node in order {
            let front = &self.fronts[number[node]];
            for (k, &unknown) in (0..).zip(&self.unknowns[front.first..front.first + front.size]) {
                local[unknown as usize] = k;
            }
            for &child in &nodes[node].children {
                let child = &self.fronts[number[child]];
                for k in child.first + child.own..child.first + child.size {
                    self.in_parent[k] = local[self.unknowns[k] as usize];
                }
            }
        }
    }
}

/// For every unknown the others that it shares an entry with, one way or the other, ascending.
fn couplings(matrix: &Matrix) -> Vec<Vec<u32>> {
    let mut coupled = vec![Vec::new(); matrix.size()];
    for row in 0..matrix.size() {
        for &column in &matrix.columns()[matrix.row_starts()[row]..matrix.row_starts()[row + 1]] {
            if column as usize != row {
                coupled[row].push(column);
                coupled[column as usize].push(row as u32);
            }
        }
    }
    for others in &mut coupled {
        others.sort_unstable();
        others.dedup();
    }
    coupled
}

/// Row and place of the entries of every column.
fn by_column(matrix: &Matrix) -> Vec<Vec<(u32, u32)>> {
    let mut columns = vec![Vec::new(); matrix.size()];
    for row in 0..matrix.size() {
        for k in matrix.row_starts()[row]..matrix.row_starts()[row + 1] {
            columns[matrix.columns()[k] as usize].push((row as u32, k as u32));
        }
    }
    columns
}

/// The unknowns of every group, in the order of elimination.
fn members(coupled: &[Vec<u32>], groups: &[Option<u32>]) -> Vec<Vec<u32>> {
    let count = groups
        .iter()
        .flatten()
        .max()
        .map_or(0, |&last| last as usize + 1);
    let mut members = vec![Vec::new(); count];
    // Groups around an unknown that has none; an unknown without any makes one of its own.
    let mut following: Vec<(u32, Vec<u32>)> = Vec::new();
    for (unknown, group) in (0..).zip(groups) {
        if let Some(group) = group {
            members[*group as usize].push(unknown);
            continue;
        }
        let around = coupled[unknown as usize].iter();
        let mut around: Vec<u32> = around.filter_map(|&other| groups[other as usize]).collect();
        around.sort_unstable();
        around.dedup();
        if around.is_empty() {
            members.push(vec![unknown]);
        } else {
            following.push((unknown, around));
        }
    }
    let mut graph = Graph::new(members.len());
    let mut group_of = vec![None; groups.len()];
    for (group, unknowns) in (0..).zip(&members) {
        for &unknown in unknowns {
            group_of[unknown as usize] = Some(group);
        }
    }
    let mut around = Vec::new();
    for (unknown, others) in coupled.iter().enumerate() {
        around.clear();
        around.extend(others.iter().filter_map(|&other| group_of[other as usize]));
        around.sort_unstable();
        around.dedup();
        if let Some(group) = group_of[unknown] {
            around
                .iter()
                .for_each(|&other| graph.couple(other, group, 1));
        } else {
            // It couples those around it through the last one.
            for &a in &around {
                around.iter().for_each(|&b| graph.couple(a, b, 1));
            }
        }
    }
    let order = graph.minimum_degree();
    let mut step = vec![0; members.len()];
    for (place, &group) in order.iter().enumerate() {
        step[group as usize] = place;
    }
    for (unknown, around) in following {
        let last = around.iter().max_by_key(|&&group| step[group as usize]);
        members[*last.expect("there is a group around") as usize].push(unknown);
    }
    order
        .iter()
        .map(|&group| std::mem::take(&mut members[group as usize]))
        .collect()
}

/// One node a group, in the order of elimination.
fn tree(coupled: &[Vec<u32>], members: &[Vec<u32>]) -> Vec<Node> {
    let mut step = vec![0_u32; coupled.len()];
    let mut at = vec![0; coupled.len()];
    let mut next = 0;
    for (place, unknowns) in members.iter().enumerate() {
        for &unknown in unknowns {
            at[unknown as usize] = place;
            step[unknown as usize] = next;
            next += 1;
        }
    }
    let mut nodes: Vec<Node> = Vec::with_capacity(members.len());
    let mut children_of = vec![Vec::new(); members.len()];
    for (place, own) in members.iter().enumerate() {
        let children: Vec<usize> = std::mem::take(&mut children_of[place]);
        let direct = own.iter().flat_map(|&unknown| &coupled[unknown as usize]);
        let passed = children.iter().flat_map(|&child| &nodes[child].border);
        let mut border: Vec<u32> = direct.chain(passed).copied().collect();
        border.retain(|&unknown| at[unknown as usize] > place);
        border.sort_unstable_by_key(|&unknown| step[unknown as usize]);
        border.dedup();
        if let Some(&unknown) = border.first() {
            children_of[at[unknown as usize]].push(place);
        }
        nodes.push(Node {
            own: own.clone(),
            border,
            children,
        });
    }
    nodes
}

/// Multiplications of an elimination of `own` of `size` unknowns, and the overhead of a front.
fn cost(own: usize, size: usize) -> f64 {
    let cube = |n: usize| (n * n * n) as f64 / 3.0;
    OVERHEAD + cube(size) - cube(size - own)
}

/// Makes one front of two where that saves work; a front that went into another is left empty.
fn joined(mut nodes: Vec<Node>) -> Vec<Node> {
    for place in 0..nodes.len() {
        for child in std::mem::take(&mut nodes[place].children) {
            let (before, after) = nodes.split_at_mut(place);
            let (child_node, node) = (&mut before[child], &mut after[0]);
            let own = child_node.own.len() + node.own.len();
            let size = node.own.len() + node.border.len();
            let apart = cost(
                child_node.own.len(),
                child_node.own.len() + child_node.border.len(),
            ) + cost(node.own.len(), size);
            if cost(own, child_node.own.len() + size) <= GROWTH * apart {
                node.own.append(&mut child_node.own);
                node.children.append(&mut child_node.children);
            } else {
                node.children.push(child);
            }
        }
    }
    nodes
}

/// The fronts that are not empty, each after its children.
fn postorder(nodes: &[Node]) -> Vec<usize> {
    let mut is_child = vec![false; nodes.len()];
    for &child in nodes.iter().flat_map(|node| &node.children) {
        is_child[child] = true;
    }
    let mut order = Vec::with_capacity(nodes.len());
    let mut open = Vec::new();
    for root in (0..nodes.len()).filter(|&k| !is_child[k] && !nodes[k].own.is_empty()) {
        open.push((root, 0));
        while let Some((node, next)) = open.pop() {
            match nodes[node].children.get(next) {
                Some(&child) => open.extend([(node, next + 1), (child, 0)]),
                None => order.push(node),
            }
        }
    }
    order
}
