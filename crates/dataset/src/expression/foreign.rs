//! Names of the language that have no value here, and why.

/// Why a function or constant of the language, in capitals, is refused; `None` for other names.
pub(super) fn reason(name: &str) -> Option<&'static str> {
    match name {
        "CPU" | "HSIZE" | "NJAC" | "NRHS" | "ORDER" => {
            Some("it tells how the integrator of another program is doing")
        }
        "FXFREQ" | "FXMODE" => Some("parts are rigid"),
        "WDTXYZ" => Some("expressions have no vectors; write its components"),
        _ if is_of_clearance(name) => Some("distances of geometries are not measured"),
        _ => None,
    }
}

/// The functions of CLEARANCE: a measure of its point on I or J, or between them, and an axis.
fn is_of_clearance(name: &str) -> bool {
    let name = name.strip_suffix(['X', 'Y', 'Z']).unwrap_or(name);
    let measure = name.strip_suffix("CLEAR");
    let measure = measure.map(|measure| measure.strip_prefix(['I', 'J']).unwrap_or(measure));
    matches!(measure, Some("" | "D" | "V" | "ACC"))
}
