//! Elements by the names of their statements.

use super::{Dataset, Header};

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
            "PART" => &self.parts.by_id(id)?.header,
            "POINT_MASS" => &self.point_masses.by_id(id)?.header,
            "MARKER" => &self.markers.by_id(id)?.header,
            "JOINT" => &self.joints.by_id(id)?.header,
            "PTCV" => &self.point_curves.by_id(id)?.header,
            "CURVE" => &self.curves.by_id(id)?.header,
            "JPRIM" => &self.primitives.by_id(id)?.header,
            "MOTION" => &self.motions.by_id(id)?.header,
            "GCON" => &self.constraints.by_id(id)?.header,
            "COUPLER" => &self.couplers.by_id(id)?.header,
            "GEAR" => &self.gears.by_id(id)?.header,
            "SFORCE" => &self.single_forces.by_id(id)?.header,
            "SPRINGDAMPER" => &self.spring_dampers.by_id(id)?.header,
            "VFORCE" => &self.vector_forces.by_id(id)?.header,
            "VTORQUE" => &self.vector_torques.by_id(id)?.header,
            "GFORCE" => &self.general_forces.by_id(id)?.header,
            "BUSHING" => &self.bushings.by_id(id)?.header,
            "FIELD" => &self.fields.by_id(id)?.header,
            "BEAM" => &self.beams.by_id(id)?.header,
            "CONTACT" => &self.contacts.by_id(id)?.header,
            "SPLINE" => &self.splines.by_id(id)?.header,
            "VARIABLE" => &self.variables.by_id(id)?.header,
            "DIFF" => &self.differentials.by_id(id)?.header,
            "ARRAY" => &self.arrays.by_id(id)?.header,
            "MATRIX" => &self.matrices.by_id(id)?.header,
            "STRING" => &self.strings.by_id(id)?.header,
            "LSE" => &self.linear_equations.by_id(id)?.header,
            "TFSISO" => &self.transfer_functions.by_id(id)?.header,
            "PINPUT" => &self.plant_inputs.by_id(id)?.header,
            "POUTPUT" => &self.plant_outputs.by_id(id)?.header,
            "REQUEST" => &self.requests.by_id(id)?.header,
            "MREQUEST" => &self.multiple_requests.by_id(id)?.header,
            "SENSOR" => &self.sensors.by_id(id)?.header,
            "FRICTION" => &self.frictions.by_id(id)?.header,
            "GRAPHICS" => &self.graphics.by_id(id)?.header,
            _ => return None,
        })
    }
}
