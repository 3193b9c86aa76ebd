//! Writer of `.msg` files: the log of a run, for people first, in the layout of Adams so that its
//! readers find the integrator's table, warnings, errors and the end of the run.

use crate::number::scientific;
use std::io::{self, Write};

/// A row of the integrator's table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepRow {
    /// Simulation time.
    pub time: f64,
    /// Size of the last step, simulation time.
    pub step: f64,
    /// Evaluations of the equations so far in this simulation.
    pub evaluations: u64,
    /// Accepted steps so far in this simulation.
    pub steps: u64,
    /// Order of the last step.
    pub order: u32,
    /// Wall time since the run began, seconds.
    pub elapsed: f64,
}

/// Writer of a `.msg`; every call is written out at once and returns the errors of the file system.
///
/// ```
/// use results::MessageWriter;
/// let mut file = Vec::new();
/// let mut log = MessageWriter::new(&mut file, "stiction", "0.1.0", None)?;
/// log.command("SIMULATE/DYNAMIC, END=1")?;
/// log.warning("FRICTION/3: its joint's reaction is not unique")?;
/// log.finish(0.11, 0.14)?;
/// let text = String::from_utf8(file)?;
/// assert!(text.contains("---- START: WARNING ----\nFRICTION/3: its"));
/// assert!(text.ends_with("Elapsed time = 0.11s,  CPU time = 0.14s,  127.27%\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct MessageWriter<W: Write> {
    out: W,
}

/// Inner width of boxes.
const WIDTH: usize = 76;

impl<W: Write> MessageWriter<W> {
    /// Writes the banner: program, version, date (`2026-01-31 12:00:00` or unknown) and process.
    pub fn new(out: W, program: &str, version: &str, date: Option<&str>) -> io::Result<Self> {
        let mut log = Self { out };
        log.write_box(&[
            format!("{program} {version}"),
            // Readers tell the dialect of a message file by these words.
            "message file in the layout of the Adams C++ Solver".to_string(),
            format!("Date: {}", date.unwrap_or("-unknown-")),
            format!("Process ID: {}", std::process::id()),
        ])?;
        Ok(log)
    }

    /// Writes on, behind a banner and what follows it.
    pub fn append(out: W) -> Self {
        Self { out }
    }

    /// What it writes to.
    pub fn get_ref(&self) -> &W {
        &self.out
    }

    /// Echo of a command.
    pub fn command(&mut self, text: &str) -> io::Result<()> {
        let text = text.replace('\n', "\n          ");
        self.write(&format!(" command: {text}\n"))
    }

    /// The title of the model in a box.
    pub fn title(&mut self, title: &str) -> io::Result<()> {
        self.write_box(&["Model Title".to_string(), title.to_string()])
    }

    /// Lines of information, indented by two blanks.
    pub fn note(&mut self, text: &str) -> io::Result<()> {
        let lines: String = text.lines().map(|line| format!("  {line}\n")).collect();
        self.write(&lines)
    }

    /// A block of warning.
    pub fn warning(&mut self, text: &str) -> io::Result<()> {
        self.write_block("WARNING", text)
    }

    /// A block of error.
    pub fn error(&mut self, text: &str) -> io::Result<()> {
        self.write_block("ERROR", text)
    }

    /// Degrees of freedom and the redundant equations left out, each as (equation, joint), for
    /// example `("Zi.Xj", "JOINT_2")`.
    pub fn degrees_of_freedom(
        &mut self,
        count: i64,
        redundant: &[(String, String)],
    ) -> io::Result<()> {
        let mut text = format!("\n  The model has {count} degrees of freedom.\n");
        if !redundant.is_empty() {
            text += "  Degree-of-freedom analysis identified redundant constraints in the model:\n";
            for (equation, joint) in redundant {
                text += &format!("   -  deactivating constraint equation  {equation} in {joint}\n");
            }
        }
        self.write(&text)
    }

    /// Begin of a simulation: its kind (`Dynamic`), the integrator (`BDF SI2`) and its error.
    pub fn begin_simulation(&mut self, kind: &str, integrator: &str, error: f64) -> io::Result<()> {
        let error = scientific(error, 6);
        self.write(&format!(
            "\n  Begin Simulation\n\n  \
             ****** Performing {kind} Simulation using {integrator} Integrator ******\n\n   \
             Integration error = {error:>15}\n\n"
        ))
    }

    /// Head of the integrator's table.
    pub fn step_table(&mut self) -> io::Result<()> {
        self.write(
            "   Simulation   Step          Function     Cumulative    Integration   Elapsed \n   \
             Time         Size          Evaluations  Steps Taken   Order         Time    \n   \
             ___________  ___________   ___________  ___________   ___________   ________\n",
        )
    }

    /// A row of the integrator's table; about ten a simulation are useful.
    pub fn step_row(&mut self, row: &StepRow) -> io::Result<()> {
        let [time, step] = [row.time, row.step].map(|x| scientific(x, 5));
        let StepRow {
            evaluations,
            steps,
            order,
            elapsed,
            ..
        } = row;
        self.write(&format!(
            "   {time:>11}  {step:>11}   {evaluations:>11}  {steps:>11}   {order:>11}   {elapsed:>8.2}\n"
        ))
    }

    /// End of a simulation.
    pub fn end_simulation(&mut self) -> io::Result<()> {
        self.write("\n  End Simulation\n\n")
    }

    /// Table of eigenvalues at a time: real and imaginary part in cycles/second, of a conjugate pair
    /// the one with the positive imaginary part.
    pub fn eigenvalues(&mut self, time: f64, values: &[[f64; 2]]) -> io::Result<()> {
        let mut text = format!(
            "\n  E I G E N V A L U E S  at time = {}\n    Number      Real(cycles/second)     \
             Imag.(cycles/second)\n",
            scientific(time, 5)
        );
        for (place, [real, imaginary]) in values.iter().enumerate() {
            let (number, real) = (place + 1, scientific(*real, 10));
            text += &format!("{number:>10}   {real:>20}");
            if *imaginary != 0.0 {
                text += &format!("  +/- {:>20}", scientific(*imaginary, 10));
            }
            text.push('\n');
        }
        // Readers take the table to end at an empty line.
        text.push('\n');
        self.write(&text)
    }

    /// End of a run that went through: wall and processor time in seconds.
    pub fn finish(&mut self, elapsed: f64, cpu: f64) -> io::Result<()> {
        self.write("Finished -----\n")?;
        self.timing(elapsed, cpu)
    }

    /// Timing alone: the last line of a run that failed.
    pub fn timing(&mut self, elapsed: f64, cpu: f64) -> io::Result<()> {
        let share = if elapsed > 0.0 {
            100.0 * cpu / elapsed
        } else {
            0.0
        };
        self.write(&format!(
            "Elapsed time = {elapsed:.2}s,  CPU time = {cpu:.2}s,  {share:.2}%\n"
        ))
    }

    fn write_block(&mut self, kind: &str, text: &str) -> io::Result<()> {
        let text = text.trim_end();
        self.write(&format!(
            "\n---- START: {kind} ----\n{text}\n---- END: {kind} ----\n\n"
        ))
    }

    fn write_box(&mut self, lines: &[String]) -> io::Result<()> {
        let rule = "*".repeat(WIDTH + 4);
        let mut text = format!("\n{rule}\n");
        for line in lines {
            for part in line.lines() {
                text += &format!("* {part:<WIDTH$} *\n");
            }
        }
        text += &format!("{rule}\n\n");
        self.write(&text)
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        self.out.write_all(text.as_bytes())?;
        self.out.flush()
    }
}
