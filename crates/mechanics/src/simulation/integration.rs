//! Dynamics between output times: steps, outputs within them, restarts.

use std::borrow::Borrow;

use numerics::bdf::{self, Bdf, Family};

use super::blocked::Blocked;
use super::failure::jammed;
use super::report::{Cause, Ending, Observer, RunError, Settings, Statistics, StepReport};
use super::stiffness::Stiffness;
use super::{Crossing, Engine, Simulation};
use crate::dynamics::{Dynamics, Formulation, Index, Sliding, Work};
use crate::instant::{Failure, Instant};
use crate::model::Label;
use crate::state::POSITIONS;

/// Part of the reactions by which they may change where a run goes on from the end of another, for gains
/// of friction to be looked at as after a step.
const LIKE_A_STEP: f64 = 0.1;
/// Change of the place of a body where a function jumps, in units of the error: what finding the jump
/// leaves is below it.
const PLACE_JUMP: f64 = 10.0;

impl Simulation {
    /// Integrates to `end`, reporting every accepted step and the states at the rising `outputs`
    /// (the last of which should be `end`), which are asked for one by one.
    ///
    /// # Errors
    /// [`RunError`]; the state is then the last good one that could be solved.
    pub fn run(
        &mut self,
        end: f64,
        outputs: impl IntoIterator<Item = impl Borrow<f64>>,
        settings: &Settings,
        observer: &mut impl Observer,
    ) -> Result<Ending, RunError> {
        let left = self.engine.as_ref().and_then(|engine| engine.left.as_ref());
        let goes_on = left == Some(&self.state);
        self.state.set_shares(self.system.switch_count());
        let mut engine = self.take_engine();
        let started = self.start(&mut engine, goes_on, end, settings);
        let ending =
            started.and_then(|()| self.integrate(&mut engine, end, outputs, settings, observer));
        self.leave(engine, ending)
    }

    /// Goes on with a run that has paused, to the same end and with the same settings; `outputs` are
    /// those that have not been told of. Gives bit for bit what the run would have given without the
    /// pause.
    ///
    /// # Errors
    /// [`RunError`], as in [`Simulation::run`].
    ///
    /// # Panics
    /// When no run has paused.
    pub fn go_on(
        &mut self,
        end: f64,
        outputs: impl IntoIterator<Item = impl Borrow<f64>>,
        settings: &Settings,
        observer: &mut impl Observer,
    ) -> Result<Ending, RunError> {
        let mut engine = self.engine.take().expect("only a paused run can go on");
        let ending = self.integrate(&mut engine, end, outputs, settings, observer);
        self.leave(engine, ending)
    }

    /// Leaves the run, unless it only pauses.
    fn leave(
        &mut self,
        mut engine: Engine,
        ending: Result<Ending, RunError>,
    ) -> Result<Ending, RunError> {
        if ending == Ok(Ending::Paused) {
            self.engine = Some(engine);
            return ending;
        }
        self.system.free_switches();
        self.state.set_shares(0);
        for sliding in engine.dynamics.take_slidings() {
            let same =
                |s: &&Sliding| (&s.element, &s.function) == (&sliding.element, &sliding.function);
            if self.slidings.iter().find(same).is_none() {
                self.slidings.push(sliding);
            }
        }
        engine.left = ending.is_ok().then(|| self.state.clone());
        self.engine = Some(engine);
        ending
    }

    /// Begins a run from the present state; `goes_on` where the last run of the same mechanism ended
    /// there.
    fn start(
        &mut self,
        engine: &mut Engine,
        goes_on: bool,
        end: f64,
        settings: &Settings,
    ) -> Result<(), RunError> {
        let Engine {
            instant,
            dynamics,
            gains,
            bdf,
            crossing,
            stiffness,
            ..
        } = engine;
        *crossing = Crossing::NONE;
        *stiffness = Stiffness::new(bdf);
        if !goes_on {
            instant.forget();
        }
        // Changed functions may have left the state off the constraints by rounding.
        self.settle(instant)?;
        let like_a_step = goes_on && self.changed_reactions(instant) <= LIKE_A_STEP;
        let (system, multipliers) = (&mut self.system, &self.multipliers);
        let jam = if like_a_step {
            gains.look_seldom(system, multipliers, &dynamics.previous)
        } else {
            gains.look(system, multipliers)
        };
        self.refuse_jam(jam)?;
        self.system.take_frictions(&self.multipliers);
        self.system.observe_loads();
        dynamics.take_pattern(instant);
        dynamics.start(&self.system, settings.formulation, self.scales);
        dynamics.error = settings.error;
        dynamics.motion_error = settings.motion_error();
        dynamics.corrector = settings.corrector;
        dynamics.steps = [settings.shortest_step, settings.longest_step];
        dynamics.observe(&self.state, end);
        dynamics.hold_switches(&mut self.system, &self.accelerations, &self.multipliers);
        bdf.set_settings(limits(settings, settings.formulation));
        let slope = self.slope();
        let first = match settings.first_step {
            Some(first) => first,
            None => self.first_step(instant, dynamics, &slope, end, settings),
        };
        self.begin(bdf, dynamics, &slope, first);
        Ok(())
    }

    /// Steps to the end, or until the observer stops or pauses the run.
    fn integrate(
        &mut self,
        engine: &mut Engine,
        end: f64,
        outputs: impl IntoIterator<Item = impl Borrow<f64>>,
        settings: &Settings,
        observer: &mut impl Observer,
    ) -> Result<Ending, RunError> {
        let Engine {
            before,
            instant,
            dynamics,
            gains,
            bdf,
            crossing,
            stiffness,
            ..
        } = engine;
        let outputs = outputs.into_iter().map(|time| *time.borrow());
        let mut outputs = outputs.peekable();
        let mut ending = Ending::Completed;
        let mut shown = bdf.time();
        let mut blocked = None;
        while bdf.time() < end && ending == Ending::Completed {
            let start = bdf.time();
            let next = outputs.peek().filter(|output| **output > start);
            let stop = match next {
                Some(output) if !settings.interpolates => output.min(end),
                _ => end,
            };
            let advanced = bdf.advance(dynamics, stop);
            self.scales = dynamics.scales;
            self.statistics = {
                let told = &self.statistics;
                total(before, bdf.statistics(), dynamics.work, told)
            };
            if let Err(error) = advanced {
                // Steps of I3 do not test what bristles make of velocities.
                let bristles = !self.state.bristle_range().is_empty();
                if bristles && dynamics.formulation() == Formulation::Adams {
                    self.go_on_stiff(bdf, dynamics, instant, settings)?;
                    continue;
                }
                // A motion may prescribe a jump of velocity, which no step of SI2 can follow; I3
                // has only positions to meet.
                let further = bdf.time() > crossing.from;
                let gives_up = dynamics.formulation().index() == Index::Three || !further;
                let mut why = self.run_error(&error, dynamics, bdf);
                if gives_up {
                    if let Some(jam) = gains.explain(&mut dynamics.system, &dynamics.multipliers) {
                        why = jammed(bdf.time(), &jam);
                    }
                    if !crossing.goes_on && self.take(bdf, dynamics, bdf.time(), instant).is_ok() {
                        blocked = Some(Blocked::new(why.clone(), self));
                    }
                    return Err(match blocked {
                        Some(blocked) => self.go_back(blocked, shown, observer),
                        None => why,
                    });
                }
                let formulas = bdf::Settings {
                    family: Family::BackwardDifferences,
                    ..limits(settings, dynamics.formulation())
                };
                self.restart(bdf, dynamics, instant, formulas)?;
                if !crossing.goes_on {
                    blocked = Some(Blocked::new(why, self));
                }
                dynamics.cross();
                *crossing = Crossing {
                    from: bdf.time(),
                    goes_on: true,
                };
                continue;
            }
            if bdf.time() == start {
                // A function jumps where the step would have begun.
                self.pass_jump(bdf, dynamics, instant, end, settings)?;
                continue;
            }
            let jam = gains.look_seldom(
                &mut dynamics.system,
                &dynamics.multipliers,
                &dynamics.previous,
            );
            let report = StepReport {
                time: bdf.time(),
                size: bdf.last_size(),
                order: bdf.order(),
                statistics: self.statistics,
            };
            while let Some(output) = outputs.next_if(|time| *time <= bdf.time()) {
                self.take(bdf, dynamics, output, instant)?;
                shown = output;
                if !observer.output(&self.snapshot()) {
                    ending = Ending::Stopped;
                    break;
                }
            }
            if !observer.step(&report) {
                ending = Ending::Stopped;
            }
            // After the outputs within the step, whose end is not good any more.
            if let Ok(Some(jam)) = jam {
                return Err(jammed(bdf.time(), &jam));
            }
            // Only now: outputs within the step needed its past.
            if crossing.goes_on && !dynamics.crosses() {
                crossing.goes_on = false;
                let formulas = limits(settings, dynamics.formulation());
                self.restart(bdf, dynamics, instant, formulas)?;
            }
            if dynamics.is_at_jump() {
                self.pass_jump(bdf, dynamics, instant, end, settings)?;
            } else if dynamics.formulation() != Formulation::Si2 && stiffness.shows(bdf) {
                self.go_on_stiff(bdf, dynamics, instant, settings)?;
            }
            if ending == Ending::Completed && bdf.time() < end && observer.pauses() {
                ending = Ending::Paused;
            }
        }
        if ending == Ending::Completed && self.state.time != end {
            self.take(bdf, dynamics, end, instant)?;
        }
        Ok(ending)
    }

    /// Starts the integrator anew from where it is, without its past, by these formulas.
    fn restart(
        &mut self,
        bdf: &mut Bdf,
        dynamics: &mut Dynamics,
        instant: &mut Instant,
        formulas: bdf::Settings,
    ) -> Result<(), RunError> {
        self.take(bdf, dynamics, bdf.time(), instant)?;
        // Other formulas forget the past that the present is taken from.
        bdf.set_settings(formulas);
        dynamics.hold_switches(&mut self.system, &self.accelerations, &self.multipliers);
        let slope = self.slope();
        self.begin(bdf, dynamics, &slope, 1e-3 * formulas.longest_step);
        Ok(())
    }

    /// Goes on by SI2 from where the integrator is, as the equations are stiff.
    fn go_on_stiff(
        &mut self,
        bdf: &mut Bdf,
        dynamics: &mut Dynamics,
        instant: &mut Instant,
        settings: &Settings,
    ) -> Result<(), RunError> {
        let stiff = Settings {
            formulation: Formulation::Si2,
            ..*settings
        };
        dynamics.take_over(stiff.formulation, stiff.motion_error());
        self.statistics.stiff_from = Some(bdf.time());
        self.restart(bdf, dynamics, instant, limits(&stiff, stiff.formulation))
    }

    /// Starts the integrator anew on the other side of the jump of a function.
    fn pass_jump(
        &mut self,
        bdf: &mut Bdf,
        dynamics: &mut Dynamics,
        instant: &mut Instant,
        end: f64,
        settings: &Settings,
    ) -> Result<(), RunError> {
        let trial = 1e-3 * settings.longest_step;
        let shares = dynamics.pass_jump(bdf.time(), bdf.value(), trial);
        self.interpolate(bdf, dynamics, bdf.time());
        let range = self.state.share_range();
        self.state.values[range].copy_from_slice(&shares);
        let before = self.state.values.clone();
        instant.forget();
        self.solve_within_step(dynamics, instant)?;
        if let Some(element) = dynamics.turned_constraint() {
            self.refuse_jump_of_place(element, &before, PLACE_JUMP * settings.error)?;
        }
        dynamics.hold_switches(&mut self.system, &self.accelerations, &self.multipliers);
        let slope = self.slope();
        let first = self.first_step(instant, dynamics, &slope, end, settings);
        self.begin(bdf, dynamics, &slope, first);
        Ok(())
    }

    /// Refuses bodies that stand elsewhere than `before` by more than `error`, for their constraint
    /// has jumped.
    fn refuse_jump_of_place(
        &self,
        element: &Label,
        before: &[f64],
        error: f64,
    ) -> Result<(), RunError> {
        let places = POSITIONS * self.state.bodies();
        let pairs = before.iter().zip(&self.state.values[..places]);
        let moved = pairs.enumerate().fold(0.0_f64, |most, (k, (a, b))| {
            // A rotation is twice the change of its quaternion.
            let unit = if k % POSITIONS < 3 {
                self.scales.length
            } else {
                0.5
            };
            most.max((a - b).abs() / unit)
        });
        if moved <= error {
            return Ok(());
        }
        Err(RunError {
            time: self.state.time,
            message: format!(
                "the function of {element} jumps, and with it the place of what it moves, which \
                 nothing can follow; give the jump a width, as by STEP"
            ),
            element: Some(element.clone()),
            cause: Cause::JumpOfPlace,
        })
    }

    /// Starts the integrator from the instant solved last.
    fn begin(&self, bdf: &mut Bdf, dynamics: &mut Dynamics, slope: &[f64], first: f64) {
        dynamics.start_multipliers(self.state.time, &self.multipliers);
        let powers = &slope[self.state.work_range()];
        dynamics.start_works(self.state.time, self.state.works(), powers);
        dynamics.start_rates(&self.accelerations, &slope[self.state.bristle_range()]);
        bdf.start(dynamics, self.state.time, &self.state.values, slope, first);
    }

    /// Brings the state onto the constraints and solves its accelerations and reactions.
    fn settle(&mut self, instant: &mut Instant) -> Result<(), RunError> {
        self.system
            .set_bristles(&self.bristle_past, self.bristle_gamma);
        let solved = instant
            .project(
                &mut self.system,
                &mut self.state,
                &self.multipliers,
                &self.scales,
            )
            .and_then(|()| {
                instant.accelerations(
                    &mut self.system,
                    &self.state,
                    &mut self.accelerations,
                    &mut self.multipliers,
                )
            });
        let Err(failure) = solved else {
            return Ok(());
        };
        let bristles = !self.state.bristle_range().is_empty() && self.bristle_gamma > 0.0;
        let rough = matches!(failure, Failure::NotConverged { .. }) && bristles;
        if let Some(jam) = self.jam_behind(&failure, instant) {
            return Err(jammed(self.state.time, &jam));
        }
        if !rough {
            return Err(self.error(&failure));
        }
        // The step itself had a solution, and its reactions are near.
        self.statistics.rough_outputs += 1;
        self.multipliers.copy_from_slice(instant.guess());
        self.accelerations
            .copy_from_slice(instant.guessed_accelerations());
        Ok(())
    }

    /// How much the last solution of the instant has changed the multipliers, as a part of the largest.
    fn changed_reactions(&self, instant: &Instant) -> f64 {
        let pairs = self.multipliers.iter().zip(instant.guess());
        let change = pairs.fold(0.0_f64, |most, (now, guess)| most.max((now - guess).abs()));
        let largest = self.multipliers.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        change / largest.max(f64::MIN_POSITIVE)
    }

    /// State, accelerations and reactions at `time` within the last accepted step.
    fn take(
        &mut self,
        bdf: &Bdf,
        dynamics: &Dynamics,
        time: f64,
        instant: &mut Instant,
    ) -> Result<(), RunError> {
        self.interpolate(bdf, dynamics, time);
        instant.forget();
        self.solve_within_step(dynamics, instant)
    }

    /// State at `time` within the last accepted step, with a guess of accelerations and reactions.
    fn interpolate(&mut self, bdf: &Bdf, dynamics: &Dynamics, time: f64) {
        bdf.interpolate(time, &mut self.state.values);
        self.state.time = time;
        self.relax_bristles(bdf, time);
        // The reactions of the step are near: bristles may know several solutions.
        self.multipliers.copy_from_slice(&dynamics.multipliers);
        let rates = self.state.rate_range();
        bdf.interpolate_slope(time, rates, &mut self.accelerations);
        self.state.normalize();
        self.system.history.clone_from(&dynamics.system.history);
        // Creep within the step counts from its start where the joint was stuck there, and back
        // from its end where the stick began within.
        for (memory, previous) in self
            .system
            .history
            .frictions
            .iter_mut()
            .zip(&dynamics.previous)
        {
            if time < bdf.time() && previous.stuck {
                *memory = *previous;
            }
        }
    }

    /// Solves the interpolated instant, on that side of the jumps of functions on which it is.
    fn solve_within_step(
        &mut self,
        dynamics: &Dynamics,
        instant: &mut Instant,
    ) -> Result<(), RunError> {
        dynamics.lend_branches(&self.state, &mut self.system);
        self.settle(instant)?;
        self.system.take_frictions(&self.multipliers);
        let range = self.state.bristle_range();
        let deflections = &mut self.state.values[range];
        self.system.write_bristles(Some(deflections), None);
        Ok(())
    }

    /// Takes the formula of the last step for the bristles at `time` within it.
    ///
    /// Given the deflection, a small change of the load changes its rate by much, and the damping
    /// of the bristles makes a force of that: reactions at an instant need not have a solution
    /// where those of a step have one. So the deflection may follow the reactions at an output by
    /// as much as it does in a step: `z = past + γ z'` through the interpolated `z` and `z'`.
    fn relax_bristles(&mut self, bdf: &Bdf, time: f64) {
        let range = self.state.bristle_range();
        self.bristle_gamma = bdf.last_gamma();
        bdf.interpolate_slope(time, range.clone(), &mut self.bristle_past);
        for (past, deflection) in self.bristle_past.iter_mut().zip(&self.state.values[range]) {
            *past = deflection - self.bristle_gamma * *past;
        }
    }

    /// A first step whose error by the formula of order one is half the tolerance, from the second
    /// derivative; that of the velocities comes from the accelerations a little later.
    fn first_step(
        &mut self,
        instant: &mut Instant,
        dynamics: &mut Dynamics,
        slope: &[f64],
        end: f64,
        settings: &Settings,
    ) -> f64 {
        let longest = settings.longest_step.min(end - self.state.time);
        let ahead = 1e-3 * longest;
        match self.curvature_error(instant, dynamics, slope, ahead) {
            Some(error) => {
                let size = (0.5 / error.max(1e-300)).sqrt();
                size.min(0.1 * longest).max(settings.shortest_step)
            }
            None => ahead,
        }
    }

    /// Error of a step of one by the formula of order one, in units of the tolerance: half the
    /// second derivative, from the slope a time `ahead`. None where that cannot be found.
    fn curvature_error(
        &mut self,
        instant: &mut Instant,
        dynamics: &mut Dynamics,
        slope: &[f64],
        ahead: f64,
    ) -> Option<f64> {
        let kept = (
            self.state.clone(),
            self.accelerations.clone(),
            self.multipliers.clone(),
        );
        self.move_ahead(ahead);
        let solved = instant.accelerations(
            &mut self.system,
            &self.state,
            &mut self.accelerations,
            &mut self.multipliers,
        );
        let later = solved.is_ok().then(|| self.slope());
        (self.state, self.accelerations, self.multipliers) = kept;
        self.system.evaluate(&self.state, false);
        self.system
            .set_solution(&self.accelerations, 1.0, &self.multipliers);
        let half_curvature: Vec<f64> = later?
            .iter()
            .zip(slope)
            .map(|(b, a)| 0.5 * (b - a) / ahead)
            .collect();
        let error = bdf::System::norm(dynamics, &half_curvature);
        error.is_finite().then_some(error)
    }

    /// Moves the state by its velocities and accelerations for a short time.
    fn move_ahead(&mut self, time: f64) {
        self.state.time += time;
        let step: Vec<f64> = self.state.velocities().iter().map(|u| u * time).collect();
        self.state.displace(&step);
        let velocities = self.state.velocities_mut().iter_mut();
        for (u, a) in velocities.zip(&self.accelerations) {
            *u += time * a;
        }
        let rates = &self.accelerations[self.system.velocity_count()..];
        for (y, rate) in self.state.states_mut().iter_mut().zip(rates) {
            *y += time * rate;
        }
    }

    /// Time derivative of the integrator's vector, at the instant solved last.
    fn slope(&mut self) -> Vec<f64> {
        let state = &self.state;
        let mut slope = vec![0.0; state.values.len()];
        state.write_position_slopes(&state.values, &mut slope);
        slope[state.rate_range()].copy_from_slice(&self.accelerations);
        let (bristles, works) = (state.bristle_range(), state.work_range());
        self.system.take_frictions(&self.multipliers);
        self.system.write_bristles(None, Some(&mut slope[bristles]));
        self.system
            .write_powers(&self.multipliers, &mut slope[works]);
        slope
    }
}

/// The limits of the integrator, and its formulas.
fn limits(settings: &Settings, formulation: Formulation) -> bdf::Settings {
    bdf::Settings {
        family: formulation.family(),
        highest_order: settings.highest_order,
        longest_step: settings.longest_step,
        shortest_step: settings.shortest_step,
        untested: settings.corrector.fixed.is_some(),
    }
}

fn total(before: &Statistics, steps: bdf::Statistics, work: Work, told: &Statistics) -> Statistics {
    Statistics {
        steps: bdf::Statistics {
            steps: before.steps.steps + steps.steps,
            rejections: before.steps.rejections + steps.rejections,
            failures: before.steps.failures + steps.failures,
            starts: before.steps.starts + steps.starts,
        },
        work: Work {
            residuals: before.work.residuals + work.residuals,
            factorisations: before.work.factorisations + work.factorisations,
            index3_steps: before.work.index3_steps + work.index3_steps,
        },
        ..*told
    }
}
