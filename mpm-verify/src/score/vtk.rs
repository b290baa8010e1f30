//! Particles in files of VTK: which arrays of points and their data become columns, and how bytes are numbers.

use crate::table::Table;

/// Most points.
pub(super) const MOST: usize = 5_000_000;
const AXES: [&str; 3] = ["x (m)", "y (m)", "z (m)"];
/// A vector or tensor: its name, unit, number of components, and columns of some of these.
type Parts = (&'static str, &'static str, usize, &'static [(usize, &'static str)]);

/// Vectors and tensors with the columns of their components; of a symmetric tensor VTK has xx, yy, zz, xy, yz and xz.
const PARTS: [Parts; 5] = [
    ("reference", "m", 3, &[(0, "reference_x (m)"), (1, "reference_y (m)"), (2, "reference_z (m)")]),
    ("displacement", "m", 3, &[(0, "ux (m)"), (1, "uy (m)"), (2, "uz (m)")]),
    ("plateau_displacement", "m", 3, &[(0, "plateau_ux (m)"), (1, "plateau_uy (m)")]),
    ("stress", "Pa", 6, &[(0, "stress_xx (Pa)"), (1, "stress_yy (Pa)"), (2, "stress_zz (Pa)"), (3, "stress_xy (Pa)")]),
    ("stress", "Pa", 9, &[(0, "stress_xx (Pa)"), (4, "stress_yy (Pa)"), (8, "stress_zz (Pa)"), (1, "stress_xy (Pa)")]),
];

/// Types of numbers: their name, those of the old format, bytes and value.
pub(super) type Kind = (&'static str, usize, fn([u8; 8]) -> f64);

/// From the first bytes, the lowest first.
const KINDS: [Kind; 10] = [
    ("Float64 double", 8, f64::from_le_bytes),
    ("Float32 float", 4, |b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
    ("Int64 long vtktypeint64", 8, |b| i64::from_le_bytes(b) as f64),
    ("UInt64 unsigned_long vtktypeuint64", 8, |b| u64::from_le_bytes(b) as f64),
    ("Int32 int vtkIdType", 4, |b| f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
    ("UInt32 unsigned_int", 4, |b| f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
    ("Int16 short", 2, |b| f64::from(i16::from_le_bytes([b[0], b[1]]))),
    ("UInt16 unsigned_short", 2, |b| f64::from(u16::from_le_bytes([b[0], b[1]]))),
    ("Int8 char signed_char", 1, |b| f64::from(b[0] as i8)),
    ("UInt8 unsigned_char", 1, |b| f64::from(b[0])),
];

pub(super) fn kind(name: &str) -> Result<&'static Kind, String> {
    let known = KINDS.iter().find(|(names, ..)| names.split(' ').any(|own| own.eq_ignore_ascii_case(name)));
    known.ok_or_else(|| format!("type {name:?}"))
}

/// Bytes of numbers of a kind, as these.
pub(super) fn numbers((_, size, value): &Kind, bytes: &[u8], big_endian: bool) -> Vec<f64> {
    bytes.chunks_exact(*size).map(|bytes| value(lowest_first(bytes, big_endian))).collect()
}

/// Up to eight bytes, the lowest first.
pub(super) fn lowest_first(bytes: &[u8], big_endian: bool) -> [u8; 8] {
    let mut all = [0; 8];
    all[..bytes.len()].copy_from_slice(bytes);
    if big_endian {
        all[..bytes.len()].reverse();
    }
    all
}

/// A number in text.
pub(super) fn number(word: &str) -> Result<f64, String> {
    word.parse().map_err(|_| format!("{word:?} is no number"))
}

/// An array of places or of data of points.
pub(super) struct Array {
    pub(super) name: String,
    pub(super) of_points: bool,
    pub(super) components: usize,
}

impl Array {
    /// Whether it becomes a column, or those of places.
    pub(super) fn is_read(&self) -> bool {
        if self.of_points { self.components == 3 } else { self.components == 1 || self.kind_of_parts().is_some() }
    }

    /// Columns of a vector or tensor that is known by its name, with its unit or without.
    fn kind_of_parts(&self) -> Option<&'static [(usize, &'static str)]> {
        let is = |name: &str, unit: &str| self.name == name || self.name == format!("{name} ({unit})");
        let known = PARTS.iter().find(|(name, unit, count, _)| *count == self.components && is(name, unit));
        known.map(|(.., columns)| *columns)
    }

    /// Columns of a vector or tensor; of a stress its mean too.
    fn parts(&self, numbers: &[f64]) -> Vec<Column> {
        let part = |k: usize| numbers.iter().skip(k).step_by(self.components).copied();
        let known = self.kind_of_parts().unwrap_or_default();
        let mut parts: Vec<_> = known.iter().map(|(k, name)| ((*name).to_owned(), part(*k).collect())).collect();
        if let [(x, _), (y, _), (z, _), _] = known {
            let mean = part(*x).zip(part(*y)).zip(part(*z)).map(|((x, y), z)| (x + y + z) / 3.0);
            parts.push(("mean_stress (Pa)".to_owned(), mean.collect()));
        }
        parts
    }
}

type Column = (String, Vec<f64>);

/// The table of arrays that are read and their numbers. A column that is there as a scalar goes before a component.
pub(super) fn table(arrays: impl Iterator<Item = Result<(Array, Vec<f64>), String>>) -> Result<Table, String> {
    let (mut columns, mut parts) = (Vec::<Column>::new(), Vec::<Column>::new());
    for array in arrays {
        let (array, numbers) = array?;
        if array.of_points {
            let along = |axis: usize| numbers.iter().skip(axis).step_by(3).copied().collect();
            columns.extend(AXES.iter().enumerate().map(|(axis, name)| ((*name).to_owned(), along(axis))));
        } else if array.components == 1 {
            columns.push((array.name, numbers));
        } else {
            parts.extend(array.parts(&numbers));
        }
    }
    parts.retain(|(name, _)| !columns.iter().any(|(own, _)| own == name));
    columns.append(&mut parts);
    if columns.is_empty() {
        return Err("no points and no scalar point data".to_owned());
    }
    let table = Table::of_columns(columns);
    table.require_finite("array", "point")?;
    Ok(table)
}
