//! The arrays and matrices of LSE and TFSISO fit one another.

use std::collections::HashMap;

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{
    Array, ArrayKind, Dataset, Header, LinearStateEquations, Matrix, TransferFunction,
};

/// Reports arrays of the wrong kind or size, and states and outputs that two systems share.
pub(super) fn check(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    let mut checks = Checks {
        dataset,
        diagnostics,
        owners: HashMap::new(),
    };
    for equations in &dataset.linear_equations {
        checks.equations(equations);
    }
    for function in &dataset.transfer_functions {
        checks.transfer_function(function);
    }
}

struct Checks<'a, 'd, 's> {
    dataset: &'a Dataset,
    diagnostics: &'d mut Diagnostics<'s>,
    /// The system that has an array as its states or outputs.
    owners: HashMap<u32, String>,
}

impl Checks<'_, '_, '_> {
    fn equations(&mut self, equations: &LinearStateEquations) {
        let owner = format!("LSE/{}", equations.header.id);
        let header = &equations.header;
        let matrix = |id: u32| {
            let matrix = self.dataset.matrices.by_id(id)?;
            Some((matrix.rows, matrix.columns))
        };
        let matrices = [Some(equations.a), equations.b, equations.c, equations.d];
        let sizes = matrices.map(|id| id.and_then(matrix));
        let largest = sizes.iter().flatten().map(|(r, c)| *r.max(c)).max();
        if largest > Some(Matrix::MOST) {
            self.refuse(
                header,
                format!(
                    "{owner}: a matrix has more than {} rows or columns",
                    Matrix::MOST
                ),
            );
            return;
        }
        let sizes = [equations.b, equations.c, equations.d].map(|id| id.and_then(matrix));
        let Some((states, width)) = matrix(equations.a) else {
            return;
        };
        if width != states {
            let message =
                format!("{owner}: A has {states} rows and {width} columns; it must be square");
            self.refuse(header, message);
            return;
        }
        self.array(header, &owner, ("X", equations.states), Some(states));
        let inputs = equations.inputs;
        let inputs = inputs.and_then(|id| self.array(header, &owner, ("U", id), None));
        let rows = sizes[1].or(sizes[2]).map(|(rows, _)| rows);
        if let Some(id) = equations.outputs {
            self.array(header, &owner, ("Y", id), rows);
        }
        if let Some(id) = equations.ic {
            self.array(header, &owner, ("IC", id), Some(states));
        }
        let expected = [
            ("B", Some(states), inputs),
            ("C", rows, Some(states)),
            ("D", rows, inputs),
        ];
        for ((name, rows, columns), found) in expected.into_iter().zip(sizes) {
            let Some(found) = found else { continue };
            let wanted = (rows.unwrap_or(found.0), columns.unwrap_or(found.1));
            if found != wanted {
                let message = format!(
                    "{owner}: {name} must have {} rows and {} columns, but has {} and {}",
                    wanted.0, wanted.1, found.0, found.1
                );
                self.refuse(header, message);
            }
        }
    }

    fn transfer_function(&mut self, function: &TransferFunction) {
        let owner = format!("TFSISO/{}", function.header.id);
        let states = function.denominator.len().saturating_sub(1);
        let header = &function.header;
        self.array(header, &owner, ("X", function.states), Some(states));
        self.array(header, &owner, ("U", function.input), Some(1));
        self.array(header, &owner, ("Y", function.output), Some(1));
    }

    /// Checks the kind and size of an array; returns the size that it gives itself.
    fn array(
        &mut self,
        header: &Header,
        owner: &str,
        (keyword, id): (&str, u32),
        size: Option<usize>,
    ) -> Option<usize> {
        let array = self.dataset.arrays.by_id(id)?;
        let kind = name(array);
        if kind != keyword {
            let message = format!("{owner}: {keyword} names ARRAY/{id}, which is of kind {kind}");
            self.refuse(header, message);
            return None;
        }
        if matches!(array.kind, ArrayKind::States | ArrayKind::Outputs) {
            let before = self.owners.insert(id, owner.to_owned());
            if let Some(before) = before.filter(|before| before != owner) {
                let message = format!("{owner}: ARRAY/{id} is {keyword} of {before} already");
                self.refuse(header, message);
            }
        }
        let given = array.count();
        if let (Some(given), Some(size)) = (given, size)
            && given != size
        {
            let message =
                format!("{owner}: {keyword}, ARRAY/{id}, has {given} elements, not {size}");
            self.refuse(header, message);
        }
        given
    }

    fn refuse(&mut self, header: &Header, message: String) {
        self.diagnostics
            .error(Code::InvalidConnection, header.span, message);
    }
}

const fn name(array: &Array) -> &'static str {
    match array.kind {
        ArrayKind::States => "X",
        ArrayKind::Outputs => "Y",
        ArrayKind::Inputs(_) => "U",
        ArrayKind::Numbers(_) => "IC",
    }
}
