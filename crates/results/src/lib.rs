//! Result files of simulations: what is in them, writing them while a simulation runs, reading them.
//!
//! | file | what | module |
//! |---|---|---|
//! | `.res` | every component of every entity at every output time, XRF XML | [`res_writer`], [`res_reader`] |
//! | `.req` | six values per request at every output time, text columns | [`req`] |
//! | `.msg` | the log of a run for people | [`msg`] |
//!
//! What a `.res` holds is said once, by a [`Layout`] of [`Entity`]s: names, units and the order of
//! the values. The writers only see plain numbers in that order. They write each step as soon as
//! they get it, so that a run that ends early leaves a readable file.
//!
//! The layouts follow files of Adams Solver (C++) 2015 to 2022, so that readers of those open ours.
//! Names of hosts and users are never written.
//!
//! # Example
//! ```
//! use results::{DataKind, Entity, Header, Layout, ResFile, ResWriter, UnitNames};
//!
//! let units = UnitNames::from_keywords("METER", "KILOGRAM", "NEWTON", "SECOND")?;
//! let mut layout = Layout::new();
//! layout.push_family(vec![Entity::part("BALL", 2, &units)], &[6, 6, 6])?;
//! let header = Header { title: "a falling ball".into(), units, ..Header::default() };
//!
//! let mut file = Vec::new();
//! let mut writer = ResWriter::new(&mut file, &header, layout)?;
//! writer.begin_data(DataKind::Dynamic)?;
//! let mut values = [0.0; 18];
//! values[1] = -0.25;
//! writer.step(0.5, &values)?;
//! writer.finish("Successful")?;
//!
//! let file = ResFile::from_reader(file.as_slice())?;
//! assert_eq!(file.get("BALL_XFORM.Y")?, [-0.25]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod channels;
pub mod energy;
pub mod friction_detail;
pub mod layout;
pub mod msg;
mod number;
pub mod req;
pub mod res_reader;
pub mod res_writer;
pub mod units;

pub use channels::{Component, Entity};
pub use energy::{ENERGY, ENERGY_COMPONENTS};
pub use friction_detail::{FRICTION_DETAIL, SurfaceMotion};
pub use layout::{Layout, LayoutError};
pub use msg::{MessageWriter, StepRow};
pub use req::{ReqWriter, Request};
pub use res_reader::{DataBlock, ReadError, ResFile};
pub use res_writer::{Blocks, DataKind, Header, ResWriter, WriteError};
pub use units::{UnitError, UnitNames};
