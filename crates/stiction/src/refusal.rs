//! Elements that are read but not simulated: no simulation may go on as if they were not there.

use dataset::{Code, Dataset, Diagnostic, Severity, Switchable};

/// An error for each of them that acts; `source` names the dataset.
pub(crate) fn acting(dataset: &Dataset, source: &str) -> Vec<Diagnostic> {
    let contacts = dataset.contacts.iter().map(|contact| &contact.header);
    let active = contacts.filter(|header| dataset.is_active(Switchable::Contact, header.id));
    let refuse = |header: &dataset::Header| {
        let id = header.id;
        let mut error = Diagnostic::new(
            Severity::Error,
            Code::UnsupportedStatement,
            source,
            header.span,
            format!("CONTACT/{id} acts here, and stiction does not simulate contacts"),
        );
        error.help(format!(
            "write DEACTIVATE/CONTACT, ID = {id} before the first SIMULATE, or the contact as an \
             SFORCE with IMPACT"
        ));
        error
    };
    active.map(refuse).collect()
}
