//! `runs.parquet`: a row a run.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::Arc;

use conik::Stack;
use conik_sim::scenario::Choice;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use crate::plan::Plan;
use crate::row::Row;
use crate::tally::PROPERTIES;

/// Rows that are gathered before they are written.
const ROWS_IN_A_GROUP: usize = 1 << 14;

/// Why the table could not be written.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// What is in it.
    #[error(transparent)]
    Parquet(#[from] ParquetError),
}

/// Cells of a column, each of which may be missing.
enum Cells {
    Number(Vec<Option<f64>>),
    Whole(Vec<Option<i64>>),
    Truth(Vec<Option<bool>>),
    Text(Vec<String>),
}

struct Column {
    name: String,
    cells: Cells,
}

/// Writes rows as they come.
pub struct Table {
    file: SerializedFileWriter<BufWriter<File>>,
    columns: Vec<Column>,
    plan: Plan,
    rows: usize,
}

impl Table {
    /// Begins a table of runs with these tasks. What was there is replaced when it is finished.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn create(path: &Path, plan: &Plan, stack: &Stack) -> Result<Self, TableError> {
        let columns = columns(plan, stack);
        let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
        let schema = Type::group_type_builder("runs")
            .with_fields(fields)
            .build()?;
        let metadata = [
            ("conik.version", plan.version.clone()),
            ("conik.scenario", plan.scenario.to_toml()),
            ("conik.seed", plan.seed.to_string()),
            (
                "conik.varied",
                serde_json::to_string(&plan.varied).unwrap_or_default(),
            ),
        ];
        let metadata = metadata.map(|(key, value)| KeyValue::new(key.to_owned(), value));
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_created_by(format!("conik {}", plan.version))
            .set_key_value_metadata(Some(metadata.into()))
            .build();
        let out = BufWriter::new(File::create(path)?);
        Ok(Self {
            file: SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?,
            columns,
            plan: plan.clone(),
            rows: 0,
        })
    }

    /// Adds a row.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn add(&mut self, row: &Row) -> Result<(), TableError> {
        let mut cells = cells(row, &self.plan).into_iter();
        for column in &mut self.columns {
            match (&mut column.cells, cells.next()) {
                (Cells::Number(column), Some(Cell::Number(cell))) => column.push(cell),
                (Cells::Whole(column), Some(Cell::Whole(cell))) => column.push(Some(cell)),
                (Cells::Truth(column), Some(Cell::Truth(cell))) => column.push(cell),
                (Cells::Text(column), Some(Cell::Text(cell))) => column.push(cell),
                // Rows of another plan have other columns.
                _ => return Err(io::Error::other("a row does not fit the plan").into()),
            }
        }
        self.rows += 1;
        if self.rows == ROWS_IN_A_GROUP {
            self.write_group()?;
        }
        Ok(())
    }

    /// Brings everything to the file.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn finish(mut self) -> Result<(), TableError> {
        if self.rows > 0 {
            self.write_group()?;
        }
        let mut out = self.file.into_inner()?;
        out.flush()?;
        Ok(out.get_ref().sync_all()?)
    }

    fn write_group(&mut self) -> Result<(), TableError> {
        let mut group = self.file.next_row_group()?;
        for column in &mut self.columns {
            let Some(mut to) = group.next_column()? else {
                break;
            };
            match &mut column.cells {
                Cells::Number(cells) => {
                    let (values, present) = given(cells);
                    to.typed::<DoubleType>()
                        .write_batch(&values, Some(&present), None)?;
                }
                Cells::Whole(cells) => {
                    let (values, present) = given(cells);
                    to.typed::<Int64Type>()
                        .write_batch(&values, Some(&present), None)?;
                }
                Cells::Truth(cells) => {
                    let (values, present) = given(cells);
                    to.typed::<BoolType>()
                        .write_batch(&values, Some(&present), None)?;
                }
                Cells::Text(cells) => {
                    let present = vec![1; cells.len()];
                    let values = cells
                        .drain(..)
                        .map(|cell| ByteArray::from(cell.into_bytes()));
                    let values: Vec<ByteArray> = values.collect();
                    to.typed::<ByteArrayType>()
                        .write_batch(&values, Some(&present), None)?;
                }
            }
            to.close()?;
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }
}

/// What is there, and for each cell whether it is; leaves none.
fn given<T>(cells: &mut Vec<Option<T>>) -> (Vec<T>, Vec<i16>) {
    let present = cells.iter().map(|cell| i16::from(cell.is_some())).collect();
    (cells.drain(..).flatten().collect(), present)
}

/// A cell of a row.
enum Cell {
    Number(Option<f64>),
    Whole(i64),
    Truth(Option<bool>),
    Text(String),
}

/// The columns of a plan, empty.
fn columns(plan: &Plan, stack: &Stack) -> Vec<Column> {
    let column = |name: String, cells: Cells| Column { name, cells };
    let number = |name: String| column(name, Cells::Number(Vec::new()));
    let whole = |name: &str| column(name.to_owned(), Cells::Whole(Vec::new()));
    let text = |name: &str| column(name.to_owned(), Cells::Text(Vec::new()));
    let sets = || {
        let sets = stack.iter().filter(|(_, level)| level.interval().is_some());
        sets.map(|(_, level)| level.name())
    };
    let equalities = stack.iter().filter(|(_, level)| level.interval().is_none());
    let mut columns = vec![
        whole("run"),
        whole("seed"),
        number("rate_hz".to_owned()),
        number("servo_lag_s".to_owned()),
        text("mode_rule"),
        text("border"),
        text("recursion"),
    ];
    columns.extend((1..=stack.dof()).map(|joint| number(format!("q{joint}_start_rad"))));
    columns.extend([
        text("outcome"),
        number("ended_at_s".to_owned()),
        whole("waypoints_reached"),
        number("arrived_s".to_owned()),
        whole("mode_changes"),
    ]);
    columns.extend(sets().map(|name| number(format!("{name}_worst"))));
    columns.extend(equalities.map(|(_, level)| number(format!("{}_error", level.name()))));
    if plan.varied.servo_lag_s.is_some() {
        columns.extend(sets().map(|name| number(format!("{name}_measured_worst"))));
    }
    for property in PROPERTIES {
        columns.push(column(property.to_owned(), Cells::Truth(Vec::new())));
        columns.push(number(format!("{property}_worst")));
    }
    columns.push(text("class"));
    columns
}

/// The cells of a row, in the order of the columns.
fn cells(row: &Row, plan: &Plan) -> Vec<Cell> {
    let control = &plan.scenario.control;
    let number = |value: f64| Cell::Number(Some(value));
    let whole = |value: u64| Cell::Whole(i64::try_from(value).unwrap_or(i64::MAX));
    let mut cells = vec![
        whole(row.run),
        Cell::Whole(plan.seed.cast_signed()),
        number(row.rate_hz),
        Cell::Number(row.servo_lag_s),
        Cell::Text(control.mode_rule.name().to_owned()),
        Cell::Text(control.border.name().to_owned()),
        Cell::Text(control.recursion.name().to_owned()),
    ];
    cells.extend(row.q0.iter().copied().map(number));
    cells.extend([
        Cell::Text(row.outcome.clone()),
        number(row.ended_at_s),
        whole(row.waypoints_reached),
        Cell::Number(row.arrived_s),
        whole(row.mode_changes),
    ]);
    cells.extend(row.violations.iter().copied().map(number));
    cells.extend(row.errors.iter().copied().map(number));
    cells.extend(
        row.measured_violations
            .iter()
            .flatten()
            .copied()
            .map(number),
    );
    for (kept, worst) in row.kept.into_iter().zip(row.worst) {
        cells.push(Cell::Truth(kept));
        cells.push(number(worst));
    }
    cells.push(Cell::Text(row.class.name().to_owned()));
    cells
}

/// A field of the schema.
fn field(column: &Column) -> Result<TypePtr, ParquetError> {
    let (physical, logical) = match &column.cells {
        Cells::Number(_) => (Physical::DOUBLE, None),
        Cells::Whole(_) => (Physical::INT64, None),
        Cells::Truth(_) => (Physical::BOOLEAN, None),
        Cells::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()?;
    Ok(Arc::new(field))
}
