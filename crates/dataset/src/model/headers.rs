//! Elements by the names of their statements.

use super::{Dataset, Header};

macro_rules! by_statement {
    ($($statement:literal $list:ident;)*) => {
        impl Dataset {
            /// What stands at the head of the statement of that name and identifier; `None` where there is
            /// no such element.
            ///
            /// ```
            /// use dataset::{read_dataset, Source};
            /// let source = Source::from_text("m.adm", "title\nPART/1, GROUND\n".to_string());
            /// let (dataset, _) = read_dataset(&source);
            /// assert_eq!(dataset.header("PART", 1).map(|header| header.id), Some(1));
            /// assert!(dataset.header("PART", 2).is_none());
            /// ```
            #[must_use]
            pub fn header(&self, statement: &str, id: u32) -> Option<&Header> {
                Some(match statement {
                    $($statement => &self.$list.by_id(id)?.header,)*
                    _ => return None,
                })
            }

            /// The names and heads of the statements of all elements, one type after another.
            ///
            /// ```
            /// use dataset::{read_dataset, Source};
            /// let source = Source::from_text("m.adm", "title\nPART/1, GROUND\n".to_string());
            /// let (dataset, _) = read_dataset(&source);
            /// let heads: Vec<_> = dataset.headers().map(|(name, head)| (name, head.id)).collect();
            /// assert_eq!(heads, [("PART", 1)]);
            /// ```
            pub fn headers(&self) -> impl Iterator<Item = (&'static str, &Header)> {
                std::iter::empty()
                    $(.chain(self.$list.iter().map(|element| ($statement, &element.header))))*
            }
        }
    };
}

by_statement! {
    "PART" parts;
    "POINT_MASS" point_masses;
    "MARKER" markers;
    "JOINT" joints;
    "PTCV" point_curves;
    "CURVE" curves;
    "JPRIM" primitives;
    "MOTION" motions;
    "GCON" constraints;
    "COUPLER" couplers;
    "GEAR" gears;
    "SFORCE" single_forces;
    "SPRINGDAMPER" spring_dampers;
    "VFORCE" vector_forces;
    "VTORQUE" vector_torques;
    "GFORCE" general_forces;
    "BUSHING" bushings;
    "FIELD" fields;
    "BEAM" beams;
    "CONTACT" contacts;
    "SPLINE" splines;
    "VARIABLE" variables;
    "DIFF" differentials;
    "ARRAY" arrays;
    "MATRIX" matrices;
    "STRING" strings;
    "LSE" linear_equations;
    "TFSISO" transfer_functions;
    "PINPUT" plant_inputs;
    "POUTPUT" plant_outputs;
    "REQUEST" requests;
    "MREQUEST" multiple_requests;
    "SENSOR" sensors;
    "FRICTION" frictions;
    "GRAPHICS" graphics;
}
