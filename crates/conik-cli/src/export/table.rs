//! Parquet: the log as one table.

use std::io::Write;
use std::sync::Arc;

use conik::JointKind;
use conik_sim::log::LogRows;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};
use serde_json::{Map, Value, json};

use super::error::ExportError;
use super::source::{Source, Watch};
use super::{Exported, VERSION};

/// Rows that are gathered before they are written: 65 MB of a log of a hundred columns.
const ROWS_IN_A_GROUP: usize = 1 << 16;

/// Writes the table.
pub fn write<W: Write + Send>(
    source: &Source,
    out: W,
    watch: Watch,
) -> Result<Exported, ExportError> {
    let mut rows = source.rows(|_| true)?;
    let mut table = Table::of(&rows);
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(format!("conik {VERSION}"))
        .set_key_value_metadata(Some(metadata(source, &rows)))
        .build();
    let schema = Arc::new(table.schema()?);
    let mut file = SerializedFileWriter::new(out, schema, Arc::new(properties))?;
    let mut count = 0;
    while rows.advance()? {
        table.add(&rows);
        count += 1;
        if table.rows == ROWS_IN_A_GROUP {
            table.write_group(&rows, &mut file)?;
            if !watch(source.share(&rows)) {
                return Err(ExportError::Stopped);
            }
        }
    }
    if count == 0 {
        return Err(source.no_rows());
    }
    if table.rows > 0 {
        table.write_group(&rows, &mut file)?;
    }
    file.close()?;
    Ok(Exported {
        rows: count,
        is_truncated: rows.is_truncated(),
    })
}

/// What the columns mean, and what was run.
fn metadata(source: &Source, rows: &LogRows) -> Vec<KeyValue> {
    let named = rows.names().iter();
    let units: Map<String, Value> = named
        .filter_map(|name| Some((name.clone(), json!(unit(source, name)?))))
        .collect();
    let pairs = [
        ("conik.version", VERSION.to_owned()),
        ("conik.units", Value::from(units).to_string()),
        ("conik.scenario", source.summary.settings.scenario.to_toml()),
        ("conik.summary", source.summary_text.clone()),
    ];
    let pairs = pairs.into_iter();
    pairs
        .map(|(key, value)| KeyValue::new(key.to_owned(), value))
        .collect()
}

/// Unit of a column of numbers, if it has one.
fn unit(source: &Source, column: &str) -> Option<String> {
    let of_task = source
        .tasks
        .iter()
        .find(|task| task.config.name == column || task.error_column() == column);
    if let Some(task) = of_task {
        return Some(task.unit.to_owned());
    }
    match column {
        "t_s" => Some("s".to_owned()),
        "waypoint" => None,
        _ if column.starts_with("tool_") => Some("m".to_owned()),
        _ => unit_of_joint(source, column),
    }
}

/// Unit of `q1_rad` and its like: that of the joint, whatever the column is called.
fn unit_of_joint(source: &Source, column: &str) -> Option<String> {
    let digits = column.trim_start_matches(['q', 'd']);
    let stem = &column[..column.len() - digits.len()];
    let (number, _) = digits.split_once('_')?;
    let joint = number.parse::<usize>().ok()?.checked_sub(1)?;
    let unit = match source.robot.joints().get(joint)?.kind {
        JointKind::Revolute => "rad",
        JointKind::Prismatic => "m",
    };
    let per = ["", "/s", "/s²"].get(stem.matches('d').count())?;
    Some(format!("{unit}{per}"))
}

/// Rows that are gathered, column by column, in the order of the file.
struct Table {
    columns: Vec<Column>,
    rows: usize,
}

struct Column {
    name: String,
    cells: Cells,
}

enum Cells {
    /// The place among the numbers of a row, and the cells.
    Double(usize, Vec<f64>),
    /// A column of whole numbers.
    Whole(usize, Vec<i32>),
    /// Numbers of modes, and for each row whether there is one.
    Mode(Vec<i64>, Vec<i16>),
    Active(Vec<u32>),
    Why(Vec<u32>),
}

impl Table {
    fn of(rows: &LogRows) -> Self {
        let column = |name: &str, cells: Cells| Column {
            name: name.to_owned(),
            cells,
        };
        let numbers = rows.names().iter().enumerate().map(|(at, name)| {
            let cells = match name.as_str() {
                "waypoint" => Cells::Whole(at, Vec::new()),
                _ => Cells::Double(at, Vec::new()),
            };
            column(name, cells)
        });
        let mut columns: Vec<Column> = numbers.collect();
        // The log has them after the time.
        columns.insert(1, column("mode", Cells::Mode(Vec::new(), Vec::new())));
        columns.insert(2, column("active", Cells::Active(Vec::new())));
        if rows.has_reasons() {
            columns.push(column("why", Cells::Why(Vec::new())));
        }
        Self { columns, rows: 0 }
    }

    fn schema(&self) -> Result<Type, ParquetError> {
        let fields = self.columns.iter().map(Column::field);
        Type::group_type_builder("log")
            .with_fields(fields.collect::<Result<_, _>>()?)
            .build()
    }

    fn add(&mut self, rows: &LogRows) {
        let row = rows.row();
        for column in &mut self.columns {
            match &mut column.cells {
                Cells::Double(at, cells) => cells.push(row.numbers[*at]),
                // Whole as the log has them.
                #[allow(clippy::cast_possible_truncation)]
                Cells::Whole(at, cells) => cells.push(row.numbers[*at] as i32),
                Cells::Mode(cells, present) => {
                    // The format has no other numbers of 64 bits; the type says that they have no sign.
                    cells.extend(row.mode.map(u64::cast_signed));
                    present.push(i16::from(row.mode.is_some()));
                }
                Cells::Active(cells) => cells.push(row.active),
                Cells::Why(cells) => cells.extend(row.why),
            }
        }
        self.rows += 1;
    }

    /// Writes what is gathered, and begins anew.
    fn write_group<W: Write + Send>(
        &mut self,
        rows: &LogRows,
        file: &mut SerializedFileWriter<W>,
    ) -> Result<(), ParquetError> {
        let (sets, codes) = (words(rows.active_sets()), words(rows.codes()));
        let mut group = file.next_row_group()?;
        for column in &mut self.columns {
            let Some(mut to) = group.next_column()? else {
                break;
            };
            match &mut column.cells {
                Cells::Double(_, cells) => {
                    to.typed::<DoubleType>().write_batch(cells, None, None)?;
                    cells.clear();
                }
                Cells::Whole(_, cells) => {
                    to.typed::<Int32Type>().write_batch(cells, None, None)?;
                    cells.clear();
                }
                Cells::Mode(cells, present) => {
                    to.typed::<Int64Type>()
                        .write_batch(cells, Some(present), None)?;
                    cells.clear();
                    present.clear();
                }
                Cells::Active(ids) => {
                    let cells = texts(ids, &sets);
                    to.typed::<ByteArrayType>()
                        .write_batch(&cells, None, None)?;
                    ids.clear();
                }
                Cells::Why(ids) => {
                    let cells = texts(ids, &codes);
                    to.typed::<ByteArrayType>()
                        .write_batch(&cells, None, None)?;
                    ids.clear();
                }
            }
            to.close()?;
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }
}

/// Lists of names as they stand in the log.
fn words(lists: &[Vec<String>]) -> Vec<ByteArray> {
    let joined = lists.iter().map(|names| names.join("+"));
    joined
        .map(|text| ByteArray::from(text.into_bytes()))
        .collect()
}

fn texts(ids: &[u32], words: &[ByteArray]) -> Vec<ByteArray> {
    ids.iter().map(|id| words[*id as usize].clone()).collect()
}

impl Column {
    fn field(&self) -> Result<TypePtr, ParquetError> {
        let (physical, logical, repetition) = match self.cells {
            Cells::Double(..) => (Physical::DOUBLE, None, Repetition::REQUIRED),
            Cells::Whole(..) => (Physical::INT32, None, Repetition::REQUIRED),
            Cells::Mode(..) => {
                let logical = LogicalType::integer(64, false);
                (Physical::INT64, Some(logical), Repetition::OPTIONAL)
            }
            Cells::Active(_) | Cells::Why(_) => {
                let logical = LogicalType::String;
                (Physical::BYTE_ARRAY, Some(logical), Repetition::REQUIRED)
            }
        };
        let field = Type::primitive_type_builder(&self.name, physical)
            .with_logical_type(logical)
            .with_repetition(repetition)
            .build()?;
        Ok(Arc::new(field))
    }
}
