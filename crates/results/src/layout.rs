//! Order of the values in a `.res`.
//!
//! A step of a `.res` is the time and then one flat list of values. Values of entities of one
//! family (all parts) are interleaved by block: first the poses of every part, then the velocities
//! of every part, then the accelerations. Everything else is one block an entity, one after another.

use crate::channels::Entity;
use std::ops::Range;

/// A family whose entities do not have the components its blocks say.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("entity `{entity}` has {components} components, its blocks hold {expected}")]
pub struct LayoutError {
    /// Name of the entity.
    pub entity: String,
    /// Number of its components.
    pub components: usize,
    /// Sum of the lengths of the blocks.
    pub expected: usize,
}

/// Entities of a `.res` and the place of each component in a step's list of values.
///
/// ```
/// use results::{Entity, Layout, UnitNames};
/// let units = UnitNames::default();
/// let parts = vec![Entity::part("A", 2, &units), Entity::part("B", 3, &units)];
/// let mut layout = Layout::new();
/// layout.push_family(parts, &[6, 6, 6])?;
/// let joint = layout.push(Entity::reaction("Joint", "J", 1, &units));
/// assert_eq!(layout.column(1, 0), 6);  // B's X comes after A's pose,
/// assert_eq!(layout.column(0, 6), 12); // A's VX after both poses,
/// assert_eq!(joint, 36..42);           // the joint after all of both parts
/// # Ok::<(), results::LayoutError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Layout {
    entities: Vec<Entity>,
    /// Column of each component of each entity.
    columns: Vec<Vec<usize>>,
    /// Number of values on each text line of a step.
    lines: Vec<usize>,
    value_count: usize,
}

impl Layout {
    /// A layout of the time alone.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an entity whose values follow one another; returns their columns.
    pub fn push(&mut self, entity: Entity) -> Range<usize> {
        let first = self.value_count;
        let columns = first..first + entity.components.len();
        self.value_count = columns.end;
        if !columns.is_empty() {
            self.lines.push(columns.len());
        }
        self.columns.push(columns.clone().collect());
        self.entities.push(entity);
        columns
    }

    /// Adds entities interleaved by blocks of the given lengths; returns the columns of them all.
    ///
    /// # Errors
    /// An entity whose number of components is not the sum of the blocks; nothing is added.
    pub fn push_family(
        &mut self,
        entities: Vec<Entity>,
        blocks: &[usize],
    ) -> Result<Range<usize>, LayoutError> {
        let expected = blocks.iter().sum();
        if let Some(entity) = entities.iter().find(|e| e.components.len() != expected) {
            return Err(LayoutError {
                entity: entity.name.clone(),
                components: entity.components.len(),
                expected,
            });
        }
        let first = self.value_count;
        let mut columns = vec![Vec::with_capacity(expected); entities.len()];
        for &block in blocks {
            for own in &mut columns {
                own.extend(self.value_count..self.value_count + block);
                self.value_count += block;
                self.lines.push(block);
            }
        }
        self.columns.append(&mut columns);
        self.entities.extend(entities);
        Ok(first..self.value_count)
    }

    /// Number of values of a step, the time not counted.
    pub fn value_count(&self) -> usize {
        self.value_count
    }

    /// Entities in the order of the file.
    pub fn entities(&self) -> &[Entity] {
        &self.entities
    }

    /// Column in a step's list of values of an entity's component, both by position.
    ///
    /// # Panics
    /// When there is no such entity or component.
    pub fn column(&self, entity: usize, component: usize) -> usize {
        self.columns[entity][component]
    }

    /// Full name (`ENTITY.COMPONENT`) of a column.
    pub fn name_of(&self, column: usize) -> Option<String> {
        self.entities
            .iter()
            .zip(&self.columns)
            .find_map(|(entity, columns)| {
                let k = columns.iter().position(|&c| c == column)?;
                Some(format!("{}.{}", entity.name, entity.components[k].name))
            })
    }

    /// Number of values on each text line of a step.
    pub(crate) fn lines(&self) -> &[usize] {
        &self.lines
    }
}
