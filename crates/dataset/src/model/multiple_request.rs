//! MREQUEST: one request for each of several elements.

use super::{Dataset, Element, Elements, Header, Request, RequestKind};
use crate::source::Span;

/// The elements that an MREQUEST is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reported {
    /// PARTS: their centres of mass, seen from the ground.
    Parts,
    /// JOINTS.
    Joints,
    /// JPRIMS.
    Primitives,
    /// APPFORS: applied forces of all types.
    Forces,
}

/// MREQUEST.
#[derive(Clone, Debug, PartialEq)]
pub struct MultipleRequest {
    /// Identifier, name and place.
    pub header: Header,
    /// What is reported; never functions.
    pub kind: RequestKind,
    /// Of what.
    pub reported: Reported,
    /// Identifiers with their places; `None` for ALL.
    pub ids: Option<Vec<(u32, Span)>>,
    /// RM: the marker in whose axes components are given; default the ground.
    pub rm: Option<u32>,
    /// COMMENT.
    pub comment: Option<String>,
}

/// An element of an MREQUEST and the markers that are reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ReportedElement {
    /// Its statement.
    pub(crate) statement: &'static str,
    pub(crate) id: u32,
    /// None for a part without a centre of mass.
    pub(crate) i: Option<u32>,
    pub(crate) j: Option<u32>,
    /// Whether J stands where I stands, so that nothing but a force can be seen from it.
    pub(crate) floating: bool,
    start: usize,
}

impl Dataset {
    /// The requests of REQUEST and then those of MREQUEST, which have its identifier and are named
    /// after it and their elements, such as `MREQUEST_1_JOINT_3`.
    #[must_use]
    pub fn all_requests(&self) -> Vec<Request> {
        let mut all: Vec<Request> = self.requests.iter().cloned().collect();
        for multiple in &self.multiple_requests {
            let own = multiple.header.name.clone();
            let own = own.unwrap_or_else(|| format!("MREQUEST_{}", multiple.header.id));
            all.extend(self.reported(multiple).into_iter().map(|element| Request {
                header: Header {
                    name: Some(format!("{own}_{}_{}", element.statement, element.id)),
                    ..multiple.header.clone()
                },
                kind: multiple.kind.clone(),
                i: element.i,
                j: element.j,
                rm: multiple.rm,
                comment: multiple.comment.clone(),
                title: None,
                component_names: Vec::new(),
                component_labels: Vec::new(),
                component_units: Vec::new(),
                results_name: None,
            }));
        }
        all
    }

    /// The elements of an MREQUEST, without those that do not exist; of forces of different types
    /// with one identifier the first is meant.
    pub(crate) fn reported(&self, multiple: &MultipleRequest) -> Vec<ReportedElement> {
        let mut all = self.reportable(multiple.reported, multiple.kind == RequestKind::Force);
        let Some(ids) = &multiple.ids else {
            all.retain(|element| element.statement != "PART" || element.i.is_some());
            return all;
        };
        all.sort_by_key(|element| (element.id, element.start));
        let found = ids.iter().filter_map(|(id, _)| {
            let place = all.partition_point(|element| element.id < *id);
            all.get(place).filter(|element| element.id == *id).copied()
        });
        found.collect()
    }

    /// The identifiers that an MREQUEST may name, sorted.
    pub(crate) fn reportable_ids(&self, reported: Reported) -> Vec<u32> {
        let all = self.reportable(reported, false);
        let mut ids: Vec<u32> = all.iter().map(|element| element.id).collect();
        ids.sort_unstable();
        ids
    }

    fn reportable(&self, reported: Reported, force: bool) -> Vec<ReportedElement> {
        match reported {
            Reported::Parts => {
                let moving = self.parts.iter().filter(|part| !part.ground);
                let part = |part: &super::Part| ReportedElement {
                    statement: "PART",
                    id: part.header.id,
                    i: part.cm,
                    j: None,
                    floating: false,
                    start: part.header.span.start,
                };
                moving.map(part).collect()
            }
            Reported::Joints => of("JOINT", &self.joints, |e| (e.i, Some(e.j))).collect(),
            Reported::Primitives => of("JPRIM", &self.primitives, |e| (e.i, Some(e.j))).collect(),
            Reported::Forces => {
                let floating = |statement, list| {
                    of(statement, list, |e: &super::VectorForce| {
                        (e.i, Some(e.j_float))
                    })
                    .map(|element| ReportedElement {
                        floating: true,
                        ..element
                    })
                };
                of("BEAM", &self.beams, |e| (e.i, Some(e.j)))
                    .chain(of("BUSHING", &self.bushings, |e| (e.i, Some(e.j))))
                    .chain(of("FIELD", &self.fields, |e| (e.i, Some(e.j))))
                    .chain(floating("GFORCE", &self.general_forces))
                    .chain(of("SFORCE", &self.single_forces, |e| {
                        // The force of nothing but I.
                        (e.i, Some(e.j).filter(|_| !(force && e.action_only)))
                    }))
                    .chain(of("SPRINGDAMPER", &self.spring_dampers, |e| {
                        (e.i, Some(e.j))
                    }))
                    .chain(floating("VFORCE", &self.vector_forces))
                    .chain(floating("VTORQUE", &self.vector_torques))
                    .collect()
            }
        }
    }
}

fn of<'a, T: Element>(
    statement: &'static str,
    list: &'a Elements<T>,
    ends: impl Fn(&T) -> (u32, Option<u32>) + 'a,
) -> impl Iterator<Item = ReportedElement> + 'a {
    list.iter().map(move |element| {
        let (header, (i, j)) = (element.header(), ends(element));
        ReportedElement {
            statement,
            id: header.id,
            i: Some(i),
            j,
            floating: false,
            start: header.span.start,
        }
    })
}
