//! Commands that change the model, and what they do to a [`Dataset`].

pub(crate) use crate::statements::{
    EQUILIBRIUM_KEYWORDS, GRAVITY_KEYWORDS, INTEGRATOR_KEYWORDS, PREFERENCES_KEYWORDS,
};

use crate::checks;
use crate::commands::read_command;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::keywords::{Keyword, Kind, keyword};
use crate::model::{
    Activity, Change, ChangeKind, CommandKind, Dataset, Equilibrium, Friction, FrictionArguments,
    Integrator, Switchable,
};
use crate::reading::Reading;
use crate::source::{Source, Span};
use crate::statements;
use crate::syntax::{Language, SyntaxTree};

/// Reads one change of the model, which can be used only if none of the diagnostics is an error.
///
/// ```
/// use dataset::{parse_change, ChangeKind, Source};
/// let source = Source::from_text("--set", "FRICTION/103, MU_STATIC=0.2".to_string());
/// let (change, diagnostics) = parse_change(&source);
/// assert!(diagnostics.is_empty());
/// assert!(matches!(change.unwrap().kind, ChangeKind::Friction { id: 103, .. }));
/// ```
#[must_use]
pub fn parse_change(source: &Source) -> (Option<Change>, Vec<Diagnostic>) {
    let mut diagnostics = Diagnostics::new(source);
    let tree = SyntaxTree::new(source, Language::Statements);
    let mut change = None;
    if let [statement] = tree.statements.as_slice() {
        let command = read_command(&tree, statement, &mut Vec::new(), &mut diagnostics);
        match command.map(|command| command.kind) {
            Some(CommandKind::Change(found)) => {
                if found.kind.lists() {
                    let message = "LIST writes to the message file of a run";
                    diagnostics
                        .error(Code::InvalidChange, found.span, message)
                        .help("use it in a command file");
                }
                change = Some(*found);
            }
            Some(_) => {
                let span = tree.span(statement);
                let message = "this command does not change the model";
                diagnostics.error(Code::InvalidChange, span, message);
            }
            None => {}
        }
    } else {
        let span = Span::new(0, source.text().len());
        diagnostics
            .error(Code::InvalidChange, span, "expected one statement")
            .help("write for example FRICTION/1, MU_STATIC = 0.2");
    }
    (change, diagnostics.finish())
}

pub(crate) fn change(reading: &Reading, kind: ChangeKind) -> CommandKind {
    CommandKind::Change(Box::new(Change {
        kind,
        source: reading.diagnostics.source.name().to_string(),
        span: reading.span,
    }))
}

/// Refuses the arguments that a command cannot change.
pub(crate) fn fixed(reading: &mut Reading, keywords: &[&'static str]) {
    for keyword in keywords {
        if reading.has(keyword) {
            let message = format!("a command cannot change {keyword} of {}", reading.label());
            let span = reading.place(keyword);
            reading
                .diagnostics
                .error(Code::InvalidChange, span, message)
                .help("change it in the dataset");
        }
    }
}

/// Reports a command without arguments.
pub(crate) fn something(reading: &mut Reading) {
    if reading.is_empty() {
        let message = format!("{} gives nothing to change", reading.label());
        reading
            .diagnostics
            .error(Code::MissingArgument, reading.head, message)
            .help("add the arguments that change, with their new values");
    }
}

/// The arguments of FRICTION as a command: those of the statement and LIST.
pub(crate) const FRICTION_KEYWORDS: [Keyword; statements::FRICTION_KEYWORDS.len() + 1] = {
    let mut keywords = [keyword("LIST", Kind::Flag); statements::FRICTION_KEYWORDS.len() + 1];
    let mut index = 0;
    while index < statements::FRICTION_KEYWORDS.len() {
        keywords[index] = statements::FRICTION_KEYWORDS[index];
        index += 1;
    }
    keywords
};

/// FRICTION as a command.
pub(crate) fn friction(reading: &mut Reading) -> Option<CommandKind> {
    fixed(reading, &["JOINT", "FORMULATION", "I_YOKE", "J_YOKE"]);
    something(reading);
    let kind = ChangeKind::Friction {
        id: reading.id,
        arguments: Box::new(statements::friction_arguments(reading)),
        list: reading.has("LIST"),
    };
    Some(change(reading, kind))
}

/// INTEGRATOR as a command.
pub(crate) fn integrator(reading: &mut Reading) -> Option<CommandKind> {
    something(reading);
    let kind = ChangeKind::Integrator(Box::new(statements::integrator(reading)));
    Some(change(reading, kind))
}

/// EQUILIBRIUM as a command.
pub(crate) fn equilibrium(reading: &mut Reading) -> Option<CommandKind> {
    something(reading);
    let kind = ChangeKind::Equilibrium(Box::new(statements::equilibrium(reading)));
    Some(change(reading, kind))
}

/// PREFERENCES as a command.
pub(crate) fn preferences(reading: &mut Reading) -> Option<CommandKind> {
    something(reading);
    let kind = ChangeKind::Preferences(statements::preferences(reading));
    Some(change(reading, kind))
}

/// ACCGRAV as a command.
pub(crate) fn gravity(reading: &mut Reading) -> Option<CommandKind> {
    something(reading);
    let kind = ChangeKind::Gravity(statements::gravity(reading));
    Some(change(reading, kind))
}

/// The value that is given, else the one before.
fn value<T>(given: Option<(T, Span)>, before: T) -> T {
    given.map_or(before, |(value, _)| value)
}

impl Friction {
    /// Takes the values of the arguments that are given.
    pub(crate) fn take(&mut self, arguments: &FrictionArguments) {
        self.mu_static = value(arguments.mu_static, self.mu_static);
        self.mu_dynamic = value(arguments.mu_dynamic, self.mu_dynamic);
        self.effect = value(arguments.effect, self.effect);
        self.inputs = value(arguments.inputs, self.inputs);
        self.overlap_delta = value(arguments.overlap_delta, self.overlap_delta);
        self.inactive_static |= arguments.inactive_static;
        for (quantity, value, _) in &arguments.quantities {
            self.set(*quantity, *value);
        }
    }
}

impl Integrator {
    /// Takes the values of the arguments that `other` gives.
    fn take(&mut self, other: &Self) {
        self.method = other.method.or(self.method);
        self.formulation = other.formulation.or(self.formulation);
        self.error = other.error.or(self.error);
        self.hinit = other.hinit.or(self.hinit);
        self.hmax = other.hmax.or(self.hmax);
        self.hmin = other.hmin.or(self.hmin);
        self.hratio = other.hratio.or(self.hratio);
        self.kmax = other.kmax.or(self.kmax);
        self.maxit = other.maxit.or(self.maxit);
        self.fixit = other.fixit.or(self.fixit);
        self.pattern = other.pattern.clone().or_else(|| self.pattern.take());
        self.corrector = other.corrector.or(self.corrector);
        self.interpolate = other.interpolate.or(self.interpolate);
        self.adaptivity = other.adaptivity.or(self.adaptivity);
        self.alpha = other.alpha.or(self.alpha);
        self.beta = other.beta.or(self.beta);
        self.gamma = other.gamma.or(self.gamma);
    }
}

impl Equilibrium {
    /// Takes the values of the arguments that `other` gives.
    fn take(&mut self, other: &Self) {
        self.alimit = other.alimit.or(self.alimit);
        self.tlimit = other.tlimit.or(self.tlimit);
        self.error = other.error.or(self.error);
        self.imbalance = other.imbalance.or(self.imbalance);
        self.stability = other.stability.or(self.stability);
        self.maxit = other.maxit.or(self.maxit);
        self.pattern = other.pattern.clone().or_else(|| self.pattern.take());
        self.method = other.method.clone().or_else(|| self.method.take());
        self.atol = other.atol.or(self.atol);
        self.rtol = other.rtol.or(self.rtol);
        self.maxitl = other.maxitl.or(self.maxitl);
    }
}

impl Dataset {
    /// Makes a change. If one of the diagnostics is an error, nothing has changed.
    ///
    /// The diagnostics belong to the source that the change was read from.
    ///
    /// ```
    /// use dataset::{parse_change, Dataset, Source};
    /// let source = Source::from_text("--set", "ACCGRAV/KGRAV=-9.81".to_string());
    /// let mut dataset = Dataset::default();
    /// assert!(dataset.apply(&parse_change(&source).0.unwrap()).is_empty());
    /// assert_eq!(dataset.gravity, Some([0.0, 0.0, -9.81]));
    /// ```
    pub fn apply(&mut self, change: &Change) -> Vec<Diagnostic> {
        // The checks below need the name of the source only.
        let source = Source::from_text(&change.source, String::new());
        let mut diagnostics = Diagnostics::new(&source);
        if self.change(change, &mut diagnostics).is_none() {
            let (name, id) = change.target();
            let message = format!("there is no {name}/{id}");
            diagnostics.error(Code::MissingElement, change.span, message);
        }
        diagnostics.finish()
    }

    /// Makes a change if nothing is wrong with it; `None` if its element does not exist.
    fn change(&mut self, change: &Change, diagnostics: &mut Diagnostics) -> Option<()> {
        match &change.kind {
            ChangeKind::Amendment(amendment) => self.amend(amendment, change, diagnostics)?,
            ChangeKind::Friction { id, arguments, .. } => {
                let friction = self.frictions.by_id_mut(*id)?;
                friction.take(arguments);
                let joint = self.joints.by_id(friction.joint);
                if let (Some(joint), Some(friction)) = (joint, self.frictions.by_id(*id)) {
                    checks::unused_arguments(friction, joint.kind, arguments, diagnostics);
                }
            }
            ChangeKind::Integrator(given) => {
                self.integrator.get_or_insert_default().take(given);
            }
            ChangeKind::Equilibrium(given) => {
                self.equilibrium.get_or_insert_default().take(given);
            }
            ChangeKind::Preferences(given) => {
                let preferences = self.preferences.get_or_insert_default();
                preferences.stop_on_failure = given.stop_on_failure.or(preferences.stop_on_failure);
            }
            ChangeKind::Activity(activity) => self.switch(activity, change.span, diagnostics),
            ChangeKind::Gravity(components) => {
                let gravity = self.gravity.get_or_insert_default();
                for (old, new) in gravity.iter_mut().zip(components) {
                    *old = new.unwrap_or(*old);
                }
            }
        }
        Some(())
    }
}

impl ChangeKind {
    /// Whether it asks for the statement to be printed.
    #[must_use]
    pub fn lists(&self) -> bool {
        match self {
            Self::Friction { list, .. } => *list,
            Self::Amendment(amendment) => amendment.list,
            _ => false,
        }
    }

    /// Whether it changes the model, rather than how it is solved or what is printed.
    #[must_use]
    pub fn is_of_model(&self) -> bool {
        match self {
            Self::Integrator(_) | Self::Equilibrium(_) | Self::Preferences(_) => false,
            Self::Amendment(amendment) => {
                amendment.statement != "SENSOR" && !amendment.arguments.is_empty()
            }
            Self::Friction { arguments, .. } => **arguments != FrictionArguments::default(),
            Self::Activity(activity) => activity.kind != Switchable::Sensor,
            _ => true,
        }
    }
}

impl Change {
    /// The statement that changes, and its identifier, 0 where it has none.
    #[must_use]
    pub const fn target(&self) -> (&'static str, u32) {
        match self.kind {
            ChangeKind::Amendment(ref amendment) => (amendment.statement, amendment.id),
            ChangeKind::Friction { id, .. } => ("FRICTION", id),
            ChangeKind::Integrator(_) => ("INTEGRATOR", 0),
            ChangeKind::Equilibrium(_) => ("EQUILIBRIUM", 0),
            ChangeKind::Preferences(_) => ("PREFERENCES", 0),
            ChangeKind::Activity(Activity { active: true, .. }) => ("ACTIVATE", 0),
            ChangeKind::Activity(_) => ("DEACTIVATE", 0),
            ChangeKind::Gravity(_) => ("ACCGRAV", 0),
        }
    }
}
