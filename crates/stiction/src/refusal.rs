//! Elements that are read but not simulated: no simulation may go on as if they were not there.

use dataset::{Code, Dataset, Diagnostic, Severity, Switchable};

/// An error for those that act, at the first of them; `source` names the dataset.
pub(crate) fn acting(dataset: &Dataset, source: &str) -> Option<Diagnostic> {
    let contacts = dataset.contacts.iter().map(|contact| &contact.header);
    let mut active = contacts.filter(|header| dataset.is_active(Switchable::Contact, header.id));
    let first = active.next()?;
    let id = first.id;
    let mut error = Diagnostic::new(
        Severity::Error,
        Code::UnsupportedStatement,
        source,
        first.span,
        format!("CONTACT/{id} acts here, and stiction does not simulate contacts"),
    );
    error.help(format!(
        "write DEACTIVATE/CONTACT, ID = {id} before the first SIMULATE, or the contact as an \
             SFORCE with IMPACT"
    ));
    let others = active.map(|header| format!("CONTACT/{}", header.id));
    error.holds_for(&others.collect::<Vec<_>>());
    Some(error)
}
