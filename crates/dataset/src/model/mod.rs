//! The typed model that a dataset describes: one struct a statement, values in model units.
//!
//! Numbers are those of the file; only angles given with the suffix `D` are converted to radians.
//! Statements keep the order of the file.

mod activity;
mod array;
mod commands;
mod contact;
mod coupler;
mod curve;
mod dataset;
mod differential;
mod elastic;
mod elements;
mod force;
mod friction;
mod headers;
mod joint;
mod linear_system;
mod motion;
mod multiple_request;
mod part;
mod request;
mod sensor;
mod settings;
mod spline;
mod texts;
mod units;
mod variable;
mod vector_force;

pub use activity::{Activity, Selection, Switchable};
pub use array::{Array, ArrayKind, Matrix, Text};
pub use commands::{
    AmendedArgument, Amendment, Change, ChangeKind, Command, CommandFile, CommandKind,
    Eigensolution, FrictionArguments, Reload, SavedIn, Simulate, SimulationKind,
};
pub use contact::{Contact, ContactFriction, ContactLaw};
pub use coupler::{CoupledFreedom, Coupler, Gear};
pub use curve::{Curve, PointCurve};
pub use dataset::Dataset;
pub use differential::DifferentialEquation;
pub use elastic::{Beam, BeamDamping, Bushing, Field};
pub use elements::{Element, Elements, Header};
pub use force::{ForceDirection, SingleForce, SpringDamper};
pub(crate) use friction::Least;
pub use friction::{
    DefaultInUse, Dimension, Effect, Formulation, Friction, FrictionInputs, FrictionQuantity,
    OverlapDelta, Yoke,
};
pub use joint::{
    GeneralConstraint, InitialCondition, Joint, JointKind, JointPrimitive, PrimitiveKind,
};
pub use linear_system::{LinearStateEquations, TransferFunction};
pub use motion::{Motion, MotionDirection, MotionLevel, MotionTarget};
pub use multiple_request::{MultipleRequest, Reported};
pub use part::{Exact, Marker, MarkerOwner, Orientation, Part, PointMass};
pub use request::{Graphics, Request, RequestKind};
pub use sensor::{Comparison, Sensor};
pub use settings::{
    Corrector, Equilibrium, IndexReduction, InitialConditions, Integrator, IntegratorMethod,
    Kinematics, OutputOptions, Preferences, ResultsOptions,
};
pub use spline::{Spline, SplineCurve};
pub(crate) use texts::Texts;
pub use units::{ForceUnit, LengthUnit, MassUnit, TimeUnit, Units};
pub use variable::{PlantPort, Variable};
pub use vector_force::VectorForce;
