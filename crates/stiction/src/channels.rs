//! What the result files hold: entities with their names, and a row of values at an instant.
//!
//! Order: parts and point masses, joints, primitives, points on curves, motions, general constraints,
//! couplers, gears, applied forces, variables, differential equations, linear
//! systems, plant inputs and outputs,
//! frictions, requests; last our own entities, one a friction and one for the energies of the model,
//! where readers that look for those of Adams do not meet them.

use dataset::{Dataset, Header};
use mechanics::expression::Register;
use mechanics::rotation::to_euler_313;
use mechanics::{ForceElement, Owner};
use results::{Component, Entity, Layout, LayoutError, Request, UnitNames};

use crate::balance::EnergyAccount;
use crate::friction_detail;
use crate::lower::{APPLIED, Column, Lowered, Outputs, Unit, view_name};
use crate::wrenches::Wrenches;

/// The channels of a model.
#[derive(Clone, Debug)]
pub(crate) struct Channels {
    layout: Layout,
    requests: Vec<Request>,
    elements: Vec<ForceElement>,
    /// Places of variables in the dataset, by plant input and output.
    ports: Vec<usize>,
    /// Number of differential equations, which are the first of the model's states.
    differentials: usize,
}

/// Values of one instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Row {
    /// In the order of the layout.
    pub(crate) values: Vec<f64>,
    /// Six values of each request.
    pub(crate) requests: Vec<[f64; 6]>,
}

impl Channels {
    /// The channels of a dataset and its lowered model.
    ///
    /// # Errors
    /// Never for the entities of this module; the layout checks them.
    pub(crate) fn new(
        dataset: &Dataset,
        lowered: &Lowered,
        units: &UnitNames,
    ) -> Result<Self, LayoutError> {
        let mut layout = Layout::new();
        layout.push_family(bodies(dataset, units), &[6, 6, 6])?;
        let mut elements = Vec::new();
        let mut push = |header: &Header, statement, kind, element| {
            let name = name(header, statement);
            layout.push(Entity::reaction(kind, &name, header.id, units));
            elements.push(element);
        };
        let joint = |place| ForceElement::Constraint(Owner::Joint(place));
        for (place, element) in dataset.joints.iter().enumerate() {
            push(&element.header, "JOINT", "Joint", joint(place));
        }
        for (place, element) in dataset.primitives.iter().enumerate() {
            let place = dataset.joints.len() + place;
            push(&element.header, "JPRIM", "Primitive_Joint", joint(place));
        }
        for (place, element) in dataset.point_curves.iter().enumerate() {
            let place = dataset.joints.len() + dataset.primitives.len() + place;
            push(&element.header, "PTCV", "Point_Curve", joint(place));
        }
        for (element, owner) in dataset.motions.iter().zip(&lowered.motions) {
            let Some(owner) = *owner else { continue };
            let motion = ForceElement::Constraint(owner);
            push(&element.header, "MOTION", "Motion", motion);
        }
        for (place, element) in dataset.constraints.iter().enumerate() {
            let constraint = ForceElement::Constraint(Owner::General(place));
            push(&element.header, "GCON", "General_Constraint", constraint);
        }
        for (place, element) in dataset.couplers.iter().enumerate() {
            let place = dataset.constraints.len() + place;
            let constraint = ForceElement::Constraint(Owner::General(place));
            push(&element.header, "COUPLER", "Coupler", constraint);
        }
        for (place, element) in dataset.gears.iter().enumerate() {
            let place = dataset.constraints.len() + dataset.couplers.len() + place;
            let constraint = ForceElement::Constraint(Owner::General(place));
            push(&element.header, "GEAR", "Gear", constraint);
        }
        for applied in APPLIED {
            for (header, places) in applied.elements(dataset) {
                let force = ForceElement::applied(places);
                push(header, applied.kind.statement(), applied.name, force);
            }
        }
        for element in &dataset.variables {
            let name = name(&element.header, "VARIABLE");
            layout.push(Entity::variable(&name, element.header.id));
        }
        for element in &dataset.differentials {
            let name = name(&element.header, "DIFF");
            layout.push(Entity::differential(&name, element.header.id));
        }
        let states = &lowered.model.states[dataset.differentials.len()..];
        for system in states.chunk_by(|a, b| a.label == b.label) {
            let label = &system[0].label;
            let name = if label.name.is_empty() {
                format!("{}_{}", label.statement, label.id)
            } else {
                label.name.clone()
            };
            let kind = "Linear_System";
            layout.push(Entity::linear_system(kind, &name, label.id, system.len()));
        }
        let mut ports = Vec::new();
        let mut add_ports = |variables: &[u32]| {
            ports.extend(
                variables
                    .iter()
                    .filter_map(|id| dataset.variables.position(*id)),
            );
        };
        for port in &dataset.plant_inputs {
            let name = name(&port.header, "PINPUT");
            layout.push(Entity::plant_input(
                &name,
                port.header.id,
                port.variables.len(),
            ));
            add_ports(&port.variables);
        }
        for port in &dataset.plant_outputs {
            let name = name(&port.header, "POUTPUT");
            layout.push(Entity::plant_output(
                &name,
                port.header.id,
                port.variables.len(),
            ));
            add_ports(&port.variables);
        }
        for friction in &dataset.frictions {
            let name = name(&friction.header, "FRICTION");
            layout.push(Entity::friction(&name, friction.header.id, units));
        }
        let requests = requests(dataset, &lowered.outputs, units, &mut layout);
        for (friction, model) in dataset.frictions.iter().zip(&lowered.model.frictions) {
            let name = name(&friction.header, "FRICTION");
            layout.push(friction_detail::entity(
                &name,
                friction.header.id,
                model,
                units,
            ));
        }
        layout.push(Entity::energy(units));
        Ok(Self {
            layout,
            requests,
            elements,
            ports,
            differentials: dataset.differentials.len(),
        })
    }

    /// Entities and components.
    pub(crate) fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The requests as the `.req` names them.
    pub(crate) fn requests(&self) -> &[Request] {
        &self.requests
    }

    /// Fills `row` with the values of a solved instant, up to which the energies went as `account`
    /// says.
    pub(crate) fn fill(
        &self,
        outputs: &Outputs,
        wrenches: &Wrenches<'_>,
        account: &EnergyAccount,
        row: &mut Row,
    ) {
        let snapshot = wrenches.snapshot();
        let values = &mut row.values;
        values.clear();
        let bodies = 0..snapshot.model().bodies.len();
        for body in bodies.clone() {
            let part = snapshot.part(body);
            values.extend_from_slice(part.origin.as_slice());
            values.extend_from_slice(&to_euler_313(&part.axes));
        }
        for body in bodies.clone() {
            let part = snapshot.part(body);
            values.extend_from_slice(part.velocity.as_slice());
            values.extend_from_slice(part.omega.as_slice());
        }
        for body in bodies {
            let acceleration = snapshot.part_acceleration(body);
            values.extend_from_slice(acceleration.linear.as_slice());
            values.extend_from_slice(acceleration.angular.as_slice());
        }
        for element in &self.elements {
            let wrench = wrenches.on_i(*element);
            values.extend_from_slice(wrench.force.as_slice());
            values.extend_from_slice(wrench.torque.as_slice());
        }
        let registers = evaluate(outputs, wrenches);
        let at = |register: Register| registers[register as usize];
        values.extend(outputs.variables.iter().map(|value| at(*value)));
        for state in 0..self.differentials {
            values.push(snapshot.state().states()[state]);
            values.push(snapshot.state_rate(state));
        }
        values.extend_from_slice(&snapshot.state().states()[self.differentials..]);
        values.extend(
            self.ports
                .iter()
                .map(|variable| at(outputs.variables[*variable])),
        );
        for friction in 0..snapshot.model().frictions.len() {
            values.extend_from_slice(&wrenches.components(friction));
        }
        row.requests.clear();
        for request in &outputs.requests {
            let columns = &request.columns;
            let value = |column: &Column| at(column.value);
            values.extend(columns.iter().flatten().map(value));
            // The two magnitudes are left out.
            let six = [1, 2, 3, 5, 6, 7];
            row.requests
                .push(six.map(|k| columns[k].as_ref().map_or(0.0, value)));
        }
        for (friction, &dissipated) in account.dissipated().iter().enumerate() {
            friction_detail::append(values, wrenches, friction, dissipated);
        }
        values.extend(account.energies(wrenches));
    }
}

/// Registers of the program of the outputs.
pub(crate) fn evaluate(outputs: &Outputs, wrenches: &Wrenches<'_>) -> Vec<f64> {
    let snapshot = wrenches.snapshot();
    let program = &outputs.program;
    let mut registers = vec![0.0; program.len()];
    if !program.is_empty() {
        let result = |number: usize| outputs.results[number].value(wrenches);
        program.evaluate(&mut registers, |input| snapshot.read(input, &result));
    }
    registers
}

/// The name of an element in results: that of Adams View, else its statement and id.
pub(crate) fn name(header: &Header, statement: &str) -> String {
    view_name(header).map_or_else(|| format!("{statement}_{}", header.id), str::to_owned)
}

fn bodies(dataset: &Dataset, units: &UnitNames) -> Vec<Entity> {
    let parts = dataset
        .parts
        .iter()
        .filter(|part| !part.ground)
        .map(|part| {
            let name = name(&part.header, "PART");
            Entity::part(&name, part.header.id, units)
        });
    let points = dataset.point_masses.iter().map(|point| {
        let name = name(&point.header, "POINT_MASS");
        let kind = "Point_Mass".to_owned();
        Entity {
            kind,
            ..Entity::part(&name, point.header.id, units)
        }
    });
    parts.chain(points).collect()
}

fn requests(
    dataset: &Dataset,
    outputs: &Outputs,
    units: &UnitNames,
    layout: &mut Layout,
) -> Vec<Request> {
    let mut heads = Vec::new();
    for (output, request) in outputs.requests.iter().zip(dataset.all_requests()) {
        let own = name(&request.header, "REQUEST");
        let result_set = request.results_name.clone().filter(|name| !name.is_empty());
        let components: Vec<Component> = output
            .columns
            .iter()
            .flatten()
            .map(|column| Component {
                name: column.name.clone(),
                unit: unit(&column.unit, units),
                label: column.label.clone(),
            })
            .collect();
        let entity = Entity::request(&own, output.id, components);
        layout.push(Entity {
            name: result_set.unwrap_or_else(|| own.clone()),
            ..entity
        });
        heads.push(Request {
            id: output.id,
            comment: request.comment.clone().unwrap_or(own),
        });
    }
    heads
}

pub(crate) fn unit(unit: &Unit, units: &UnitNames) -> String {
    match unit {
        Unit::Given(name) => name.clone(),
        Unit::Length => units.length.clone(),
        Unit::Angle => units.angle.clone(),
        Unit::Velocity => units.velocity(),
        Unit::AngularVelocity => units.angular_velocity(),
        Unit::Acceleration => units.acceleration(),
        Unit::AngularAcceleration => units.angular_acceleration(),
        Unit::Force => units.force.clone(),
        Unit::Torque => units.torque(),
        Unit::Plain => String::new(),
    }
}

/// Names of the units of a dataset; the names of the quantities where a dataset has no units.
pub(crate) fn unit_names(dataset: &Dataset) -> UnitNames {
    let units = dataset.units.clone().unwrap_or_default();
    let known = (units.length, units.mass, units.force, units.time);
    let (Some(length), Some(mass), Some(force), Some(time)) = known else {
        return UnitNames {
            length: "length".into(),
            mass: "mass".into(),
            force: "force".into(),
            time: "time".into(),
            ..UnitNames::default()
        };
    };
    let keywords = UnitNames::from_keywords(
        length.keyword(),
        mass.keyword(),
        force.keyword(),
        time.keyword(),
    );
    // A unit that result files have no two-letter tag for keeps its own name.
    keywords.unwrap_or_else(|_| UnitNames {
        length: length.result_name().into(),
        mass: mass.result_name().into(),
        force: force.result_name().into(),
        time: time.result_name().into(),
        lengths_per_meter: 1.0 / length.si(),
        ..UnitNames::default()
    })
}
