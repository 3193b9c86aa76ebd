//! REQUEST and VARIABLE as outputs, in one program that gives them all, and what SENSORs watch.

use dataset::{Code, Expr, Function, Request, RequestKind};
use mechanics::expression::{Input, Operation, Program, Register};

use super::Lowering;
use super::expression::{Compiler, Reads};
use super::results::ResultSource;

/// One column of a request.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Column {
    /// Name of the component.
    pub(crate) name: String,
    /// Unit as the request gives it (CUNITS), else by its kind.
    pub(crate) unit: Unit,
    /// Label of plots (CLABELS).
    pub(crate) label: Option<String>,
    /// Where its value is.
    pub(crate) value: Register,
}

/// Unit of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    /// As the request says.
    Given(String),
    /// Length.
    Length,
    /// Angle.
    Angle,
    /// Length/time.
    Velocity,
    /// Angle/time.
    AngularVelocity,
    /// Length/time².
    Acceleration,
    /// Angle/time².
    AngularAcceleration,
    /// Force.
    Force,
    /// Force × length.
    Torque,
    /// None known.
    Plain,
}

/// A request as eight columns, of which some may be absent.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RequestOutput {
    /// Id in the dataset.
    pub(crate) id: u32,
    /// The columns: magnitude and three components, twice.
    pub(crate) columns: [Option<Column>; 8],
}

/// Everything that is evaluated for outputs only.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Outputs {
    /// Evaluates all of them.
    pub(crate) program: Program,
    /// Results that the program reads, by number.
    pub(crate) results: Vec<ResultSource>,
    /// Value of each variable, in the order of the dataset.
    pub(crate) variables: Vec<Register>,
    /// The requests, in the order of [`dataset::Dataset::all_requests`].
    pub(crate) requests: Vec<RequestOutput>,
    /// What each sensor watches and what it keeps, in the order of the dataset.
    pub(crate) sensors: Vec<(Program, Option<Program>)>,
}

/// Names of the columns of a standard request, its functions by column (marker arguments i, j and
/// rm are added), and its units.
struct Standard {
    names: [&'static str; 8],
    functions: [Option<Function>; 8],
    units: [Unit; 2],
}

impl Lowering<'_> {
    /// The outputs; call it after everything else, as the other functions decide about the
    /// measures that a step needs.
    pub(super) fn outputs(&mut self) -> Outputs {
        let dataset = self.dataset;
        let mut compiler = Compiler::new(Reads::Outputs);
        let mut outputs = Outputs::default();
        for variable in &dataset.variables {
            if let Ok(value) = compiler.variable(self, variable.header.id) {
                outputs.variables.push(value);
            }
        }
        for request in dataset.all_requests() {
            outputs.requests.push(RequestOutput {
                id: request.header.id,
                columns: self.request(&mut compiler, &request),
            });
        }
        for sensor in &dataset.sensors {
            let mut read = |function| self.function(sensor, "SENSOR", Reads::Outputs, function);
            let watched = read(&sensor.function);
            let kept = sensor.evaluate.as_ref().and_then(&mut read);
            outputs
                .sensors
                .extend(watched.map(|watched| (watched, kept)));
        }
        outputs.program = compiler.program;
        outputs.results.clone_from(&self.results);
        outputs
    }

    fn request(&mut self, compiler: &mut Compiler, request: &Request) -> [Option<Column>; 8] {
        let owner = format!("REQUEST/{}", request.header.id);
        let mut columns: [Option<Column>; 8] = Default::default();
        if let RequestKind::Functions(functions) = &request.kind {
            for (k, function) in functions.iter().enumerate() {
                let Some(function) = function else { continue };
                let Ok(value) = compiler.add(self, &owner, function) else {
                    continue;
                };
                let name = format!("F{}", k + 1);
                columns[k] = Some(Column {
                    name,
                    unit: Unit::Plain,
                    label: None,
                    value,
                });
            }
        } else {
            let standard = standard(&request.kind);
            for k in 0..8 {
                let Some(function) = standard.functions[k] else {
                    continue;
                };
                let value = self.standard_column(compiler, request, function);
                let name = standard.names[k].to_owned();
                let unit = standard.units[k / 4].clone();
                columns[k] = Some(Column {
                    name,
                    unit,
                    label: None,
                    value,
                });
            }
        }
        for (k, column) in columns.iter_mut().enumerate() {
            rename(column, request, k);
        }
        columns
    }

    fn standard_column(
        &mut self,
        compiler: &mut Compiler,
        request: &Request,
        function: Function,
    ) -> Register {
        let id = |id: Option<u32>| Expr::Number(f64::from(id.unwrap_or(0)));
        let arguments = match function {
            Function::Dm
            | Function::Vm
            | Function::Accm
            | Function::Wm
            | Function::Wdtm
            | Function::Fm
            | Function::Tm
            | Function::Psi
            | Function::Theta
            | Function::Phi => {
                vec![id(request.i), id(request.j)]
            }
            _ => vec![id(request.i), id(request.j), id(request.rm)],
        };
        let (dataset, ground) = (self.dataset, self.ground);
        let marker = |id: Option<u32>| {
            id.and_then(|id| dataset.markers.position(id))
                .unwrap_or(ground)
        };
        if let Some(measure) = self.measures.of_call(function, &arguments, marker) {
            return compiler
                .program
                .push(Operation::Input(Input::Measure(measure)));
        }
        match ResultSource::of_call(self, function, &arguments) {
            Some(source) => compiler.result(self, source),
            None => {
                let span = request.header.span;
                let message = format!("REQUEST/{} cannot be simulated", request.header.id);
                self.error(Code::UnsupportedStatement, span, message, None);
                compiler.program.push(Operation::Constant(0.0))
            }
        }
    }
}

/// I relative to J, resolved along RM; velocities and accelerations as seen from ground.
fn standard(kind: &RequestKind) -> Standard {
    use Function as F;
    match kind {
        RequestKind::Displacement => Standard {
            names: ["MAG", "X", "Y", "Z", "", "PSI", "THETA", "PHI"],
            // What the column of the second magnitude holds in Adams is not known.
            functions: [
                Some(F::Dm),
                Some(F::Dx),
                Some(F::Dy),
                Some(F::Dz),
                None,
                Some(F::Psi),
                Some(F::Theta),
                Some(F::Phi),
            ],
            units: [Unit::Length, Unit::Angle],
        },
        RequestKind::Velocity => Standard {
            names: ["VM", "VX", "VY", "VZ", "WM", "WX", "WY", "WZ"],
            functions: [F::Vm, F::Vx, F::Vy, F::Vz, F::Wm, F::Wx, F::Wy, F::Wz].map(Some),
            units: [Unit::Velocity, Unit::AngularVelocity],
        },
        RequestKind::Acceleration => Standard {
            names: [
                "ACCM", "ACCX", "ACCY", "ACCZ", "WDTM", "WDTX", "WDTY", "WDTZ",
            ],
            functions: [
                F::Accm,
                F::Accx,
                F::Accy,
                F::Accz,
                F::Wdtm,
                F::Wdtx,
                F::Wdty,
                F::Wdtz,
            ]
            .map(Some),
            units: [Unit::Acceleration, Unit::AngularAcceleration],
        },
        RequestKind::Force | RequestKind::Functions(_) => Standard {
            names: ["FM", "FX", "FY", "FZ", "TM", "TX", "TY", "TZ"],
            functions: [F::Fm, F::Fx, F::Fy, F::Fz, F::Tm, F::Tx, F::Ty, F::Tz].map(Some),
            units: [Unit::Force, Unit::Torque],
        },
    }
}

/// CNAMES, CUNITS and CLABELS of column `k`; an empty name drops the column.
fn rename(column: &mut Option<Column>, request: &Request, k: usize) {
    if request.component_names.get(k).is_some_and(String::is_empty) {
        *column = None;
    }
    let Some(column) = column else { return };
    if let Some(name) = request.component_names.get(k) {
        column.name.clone_from(name);
    }
    if let Some(unit) = request
        .component_units
        .get(k)
        .filter(|unit| !unit.is_empty())
    {
        column.unit = Unit::Given(unit.clone());
    }
    column.label = request
        .component_labels
        .get(k)
        .filter(|label| !label.is_empty())
        .cloned();
}
