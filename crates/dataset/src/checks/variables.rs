//! VARIABLEs that define each other in a circle.

use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Expr, Function};
use crate::model::Dataset;
use crate::source::Span;

/// Reports every circle where its first variable is defined.
pub(super) fn check(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    for circle in circles(dataset) {
        let span = dataset.variables[circle[0]].function.span;
        report(dataset, &circle, span, diagnostics);
    }
}

/// A longer circle is named by its first variables.
const MOST_NAMES: usize = 8;

/// The circles of VARVAL, each by the positions of its first variables.
pub(crate) fn circles(dataset: &Dataset) -> Vec<Vec<usize>> {
    let mut circles = Vec::new();
    let uses: Vec<Vec<usize>> = dataset
        .variables
        .iter()
        .map(|variable| used_variables(dataset, &variable.function.root))
        .collect();
    // Depth-first search on an explicit stack: 0 = not seen, 1 = on the path, 2 = done.
    let mut state = vec![0_u8; uses.len()];
    let mut place_on_path = vec![0; uses.len()];
    for start in 0..uses.len() {
        if state[start] != 0 {
            continue;
        }
        state[start] = 1;
        place_on_path[start] = 0;
        let mut path = vec![(start, 0)];
        while let Some((node, next)) = path.last_mut() {
            let node = *node;
            let Some(used) = uses[node].get(*next).copied() else {
                state[node] = 2;
                path.pop();
                continue;
            };
            *next += 1;
            if state[used] == 0 {
                state[used] = 1;
                place_on_path[used] = path.len();
                path.push((used, 0));
            } else if state[used] == 1 {
                let circle = path[place_on_path[used]..].iter().map(|(node, _)| *node);
                circles.push(circle.take(MOST_NAMES + 1).collect());
            }
        }
    }
    circles
}

/// Reports one circle, naming its variables.
pub(crate) fn report(
    dataset: &Dataset,
    circle: &[usize],
    span: Span,
    diagnostics: &mut Diagnostics,
) {
    let mut names: Vec<String> = circle
        .iter()
        .take(MOST_NAMES)
        .map(|index| format!("VARIABLE/{}", dataset.variables[*index].header.id))
        .collect();
    if circle.len() > MOST_NAMES {
        names.push("...".to_string());
    }
    names.push(names[0].clone());
    let message = format!(
        "variables define each other in a circle: {}",
        names.join(" -> ")
    );
    diagnostics
        .error(Code::CircularVariables, span, message)
        .help("implicit variables are not simulated");
}

/// The positions of the variables that an expression uses.
fn used_variables(dataset: &Dataset, root: &Expr) -> Vec<usize> {
    let mut used = Vec::new();
    root.visit(&mut |node| {
        if let Expr::Call {
            function: Function::Varval,
            arguments,
            ..
        } = node
        {
            let id = arguments.first().and_then(Expr::as_id);
            used.extend(id.and_then(|id| dataset.variables.position(id)));
        }
    });
    used
}
