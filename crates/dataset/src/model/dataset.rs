//! The whole model.

use super::{
    Array, Beam, Bushing, Contact, Coupler, Curve, DifferentialEquation, Elements, Equilibrium,
    Field, Friction, Gear, GeneralConstraint, Graphics, InitialConditions, Integrator, Joint,
    JointPrimitive, Kinematics, LinearStateEquations, Marker, Matrix, Motion, MultipleRequest,
    OutputOptions, Part, PlantPort, PointCurve, PointMass, Preferences, Request, ResultsOptions,
    Sensor, SingleForce, Spline, SpringDamper, Switchable, Text, Texts, TransferFunction, Units,
    Variable, VectorForce,
};
use std::collections::BTreeSet;

/// A dataset: everything that stiction understands of an `.adm` file.
///
/// It can be used only if reading it gave no diagnostic of [`Severity::Error`](crate::Severity).
/// Then every reference by id leads to an element, exactly one part is the ground, and every
/// number is finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dataset {
    /// The first line of the file, without blanks at its end.
    pub title: String,
    /// UNITS; without it numbers are taken as consistent, see [`Units::default`].
    pub units: Option<Units>,
    /// ACCGRAV: acceleration of gravity, components in the ground frame.
    pub gravity: Option<[f64; 3]>,
    /// PART.
    pub parts: Elements<Part>,
    /// `POINT_MASS`.
    pub point_masses: Elements<PointMass>,
    /// MARKER.
    pub markers: Elements<Marker>,
    /// JOINT.
    pub joints: Elements<Joint>,
    /// JPRIM.
    pub primitives: Elements<JointPrimitive>,
    /// PTCV.
    pub point_curves: Elements<PointCurve>,
    /// MOTION.
    pub motions: Elements<Motion>,
    /// GCON.
    pub constraints: Elements<GeneralConstraint>,
    /// COUPLER.
    pub couplers: Elements<Coupler>,
    /// GEAR.
    pub gears: Elements<Gear>,
    /// SFORCE.
    pub single_forces: Elements<SingleForce>,
    /// SPRINGDAMPER.
    pub spring_dampers: Elements<SpringDamper>,
    /// VFORCE.
    pub vector_forces: Elements<VectorForce>,
    /// VTORQUE.
    pub vector_torques: Elements<VectorForce>,
    /// GFORCE.
    pub general_forces: Elements<VectorForce>,
    /// BUSHING.
    pub bushings: Elements<Bushing>,
    /// FIELD.
    pub fields: Elements<Field>,
    /// BEAM.
    pub beams: Elements<Beam>,
    /// CONTACT, none of which is simulated.
    pub contacts: Elements<Contact>,
    /// CURVE.
    pub curves: Elements<Curve>,
    /// SPLINE.
    pub splines: Elements<Spline>,
    /// VARIABLE.
    pub variables: Elements<Variable>,
    /// DIFF.
    pub differentials: Elements<DifferentialEquation>,
    /// ARRAY.
    pub arrays: Elements<Array>,
    /// MATRIX.
    pub matrices: Elements<Matrix>,
    /// STRING.
    pub strings: Elements<Text>,
    /// LSE.
    pub linear_equations: Elements<LinearStateEquations>,
    /// TFSISO.
    pub transfer_functions: Elements<TransferFunction>,
    /// PINPUT.
    pub plant_inputs: Elements<PlantPort>,
    /// POUTPUT.
    pub plant_outputs: Elements<PlantPort>,
    /// REQUEST.
    pub requests: Elements<Request>,
    /// MREQUEST.
    pub multiple_requests: Elements<MultipleRequest>,
    /// SENSOR.
    pub sensors: Elements<Sensor>,
    /// FRICTION.
    pub frictions: Elements<Friction>,
    /// GRAPHICS, kept for pictures.
    pub graphics: Elements<Graphics>,
    /// OUTPUT.
    pub output: OutputOptions,
    /// RESULTS.
    pub results: ResultsOptions,
    /// INTEGRATOR.
    pub integrator: Option<Integrator>,
    /// EQUILIBRIUM.
    pub equilibrium: Option<Equilibrium>,
    /// KINEMATICS.
    pub kinematics: Option<Kinematics>,
    /// IC.
    pub initial_conditions: Option<InitialConditions>,
    /// PREFERENCES.
    pub preferences: Option<Preferences>,
    /// What DEACTIVATE has switched off, by type and identifier; see [`Dataset::is_active`].
    pub inactive: BTreeSet<(Switchable, u32)>,
    /// How its statements are written.
    pub(crate) texts: Texts,
}

impl Dataset {
    /// The part that is the ground.
    #[must_use]
    pub fn ground(&self) -> Option<&Part> {
        self.parts.iter().find(|part| part.ground)
    }
}
