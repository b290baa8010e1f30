//! Typed parameters of a case, with their ranges.

use crate::Error;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The value of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// A boolean.
    Boolean(bool),
    /// A number (an integer is one without a fraction).
    Number(f64),
    /// A choice.
    Choice(String),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Boolean(b) => write!(f, "{b}"),
            Self::Number(x) => write!(f, "{x}"),
            Self::Choice(c) => f.write_str(c),
        }
    }
}

/// Allowed values of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Domain {
    /// A number from `least` to `most`; with `below` the upper end is excluded.
    Number {
        /// Least value.
        least: f64,
        /// Greatest value.
        most: f64,
        /// Whether `most` itself is excluded.
        below: bool,
    },
    /// A whole number from `least` to `most`.
    Integer {
        /// Least value.
        least: i32,
        /// Greatest value.
        most: i32,
    },
    /// True or false.
    Boolean,
    /// One of some words.
    Choice(&'static [&'static str]),
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number { least, most, below } => {
                let [least, most] = [least, most].map(|x| short(*x));
                write!(f, "{least} to {}{most}", if *below { "below " } else { "" })
            }
            Self::Integer { least, most } => write!(f, "a whole number from {least} to {most}"),
            Self::Boolean => f.write_str("true, false"),
            Self::Choice(words) => f.write_str(&words.join(", ")),
        }
    }
}

/// A bound as short as it can be written.
fn short(x: f64) -> String {
    match x != 0.0 && !(1e-4..1e6).contains(&x.abs()) {
        true => format!("{x:e}"),
        false => x.to_string(),
    }
}

/// A parameter of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Name.
    pub name: &'static str,
    /// Unit, `-` for none.
    pub unit: &'static str,
    /// Default, as it would be written with `--set`.
    pub default: &'static str,
    /// Allowed values.
    pub domain: Domain,
    /// Meaning, for the help.
    pub meaning: &'static str,
}

impl Parameter {
    /// The same with another default.
    #[must_use]
    pub const fn with_default(self, default: &'static str) -> Self {
        Self { default, ..self }
    }

    /// The same with other allowed values.
    #[must_use]
    pub const fn within(self, domain: Domain) -> Self {
        Self { domain, ..self }
    }

    /// The same with another meaning.
    #[must_use]
    pub const fn meaning(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }
}

/// A number from `least` to `most`; with `below` the upper end is excluded.
#[must_use]
pub const fn number(least: f64, most: f64, below: bool) -> Domain {
    Domain::Number { least, most, below }
}

/// A parameter by name, unit, default, domain and meaning.
#[must_use]
pub const fn parameter(
    name: &'static str,
    unit: &'static str,
    default: &'static str,
    domain: Domain,
    meaning: &'static str,
) -> Parameter {
    Parameter { name, unit, default, domain, meaning }
}

/// Parameters: a constant each by name, unit, default, domain and meaning; or a struct with a field each, by type,
/// parameter and meaning.
#[macro_export]
macro_rules! parameters {
    ($(#[$doc:meta])* $seen:vis struct $name:ident {
        $($field:ident: $kind:ty = $parameter:expr $(, $meaning:literal)?;)*
    }) => {
        $(#[$doc])*
        #[derive(Debug, Clone)]
        $seen struct $name { $($seen $field: $kind),* }

        impl $crate::parameter::ParameterSet for $name {
            fn list() -> Vec<$crate::parameter::Parameter> {
                vec![$($parameter$(.meaning($meaning))?.named(stringify!($field))),*]
            }

            fn read(values: &$crate::parameter::Parameters) -> Result<Self, $crate::Error> {
                Ok(Self { $($field: values.read($parameter.named(stringify!($field)))?),* })
            }
        }
    };
    ($seen:vis const: $($parameter:ident =
        $name:literal, $unit:literal, $default:expr, $domain:expr, $meaning:literal;)*) => {
        $(#[doc = concat!("Parameter `", $name, "`: ", $meaning, ".")]
        $seen const $parameter: $crate::parameter::Parameter =
            $crate::parameter::parameter($name, $unit, $default, $domain, $meaning);)*
    };
}
pub use parameters;

/// A number from `least` to `most` by unit and default; named by the field of [`parameters`] that it stands at.
#[must_use]
pub const fn real(unit: &'static str, default: &'static str, least: f64, most: f64) -> Parameter {
    parameter("", unit, default, number(least, most, false), "")
}

/// A whole number from `least` to `most` by unit and default.
#[must_use]
pub const fn whole(unit: &'static str, default: &'static str, least: i32, most: i32) -> Parameter {
    parameter("", unit, default, Domain::Integer { least, most }, "")
}

/// True or false, by default.
#[must_use]
pub const fn flag(default: bool) -> Parameter {
    let default = if default { "true" } else { "false" };
    parameter("", "-", default, Domain::Boolean, "")
}

impl Parameter {
    /// The same with another name.
    #[must_use]
    pub const fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// The same without the upper end of its range.
    #[must_use]
    pub const fn below(self) -> Self {
        match self.domain {
            Domain::Number { least, most, .. } => self.within(number(least, most, true)),
            _ => self,
        }
    }
}

/// The type of a parameter's value.
pub trait Typed: Sized {
    /// Reads a value; nothing if it is of another type.
    fn typed(value: &Value) -> Option<Self>;
}

impl Typed for f64 {
    fn typed(value: &Value) -> Option<Self> {
        match value {
            Value::Number(x) => Some(*x),
            _ => None,
        }
    }
}

impl Typed for i32 {
    fn typed(value: &Value) -> Option<Self> {
        f64::typed(value).map(|x| x as Self)
    }
}

impl Typed for usize {
    fn typed(value: &Value) -> Option<Self> {
        f64::typed(value).map(|x| x as Self)
    }
}

impl Typed for bool {
    fn typed(value: &Value) -> Option<Self> {
        match value {
            Value::Boolean(b) => Some(*b),
            _ => None,
        }
    }
}

/// The parameters of a case as a struct.
pub trait ParameterSet: Sized + Clone + Send + Sync + 'static {
    /// The list of them, in the order of the fields.
    fn list() -> Vec<Parameter>;

    /// Reads their values; those that are missing have their defaults.
    ///
    /// # Errors
    /// A value of another type.
    fn read(values: &Parameters) -> Result<Self, Error>;
}

impl ParameterSet for () {
    fn list() -> Vec<Parameter> {
        Vec::new()
    }

    fn read(_: &Parameters) -> Result<Self, Error> {
        Ok(())
    }
}

/// Enumerations, each with the words of a parameter as its variants.
#[macro_export]
macro_rules! choices {
    ($($(#[$doc:meta])* $seen:vis enum $name:ident { $($variant:ident = $word:literal),+ $(,)? })+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        $seen enum $name { $(#[doc = concat!("`", $word, "`.")] $variant),+ }

        impl $name {
            /// A parameter that is this by default.
            #[must_use]
            $seen const fn by_default(self) -> $crate::parameter::Parameter {
                const WORDS: &[&str] = &[$($word),+];
                let domain = $crate::parameter::Domain::Choice(WORDS);
                $crate::parameter::parameter("", "-", WORDS[self as usize], domain, "")
            }
        }

        impl $crate::parameter::Typed for $name {
            fn typed(value: &$crate::parameter::Value) -> Option<Self> {
                match value {
                    $($crate::parameter::Value::Choice(word) if word == $word => Some(Self::$variant),)+
                    _ => None,
                }
            }
        }
    )+};
}
pub use choices;

impl Parameter {
    /// Reads a value.
    ///
    /// # Errors
    /// A value that is malformed, not finite or out of range; the error names what is allowed.
    pub fn parse(&self, text: &str) -> Result<Value, Error> {
        let refuse = |why: &str| {
            Err(Error(format!(
                "parameter {}: \"{text}\" {why}; allowed: {}{}",
                self.name,
                self.domain,
                if self.unit == "-" { String::new() } else { format!(" ({})", self.unit) }
            )))
        };
        match self.domain {
            Domain::Choice(words) if words.contains(&text) => Ok(Value::Choice(text.to_owned())),
            Domain::Choice(_) => refuse("is not a choice"),
            Domain::Boolean => match text.parse() {
                Ok(b) => Ok(Value::Boolean(b)),
                Err(_) => refuse("is not a boolean"),
            },
            Domain::Number { least, most, below } => match text.parse::<f64>() {
                Err(_) => refuse("is not a number"),
                Ok(x) if !x.is_finite() => refuse("is not finite"),
                Ok(0.0) if says_more_than_zero(text) => refuse("is too small to be told from 0"),
                Ok(x) if x < least || x > most || (below && x == most) => refuse("is out of range"),
                // Both zeros become +0: the sign of −0 would be visible in quotients.
                Ok(x) => Ok(Value::Number(x + 0.0)),
            },
            Domain::Integer { least, most } => match text.parse::<i32>() {
                Err(_) => refuse("is not a whole number"),
                Ok(n) if n < least || n > most => refuse("is out of range"),
                Ok(n) => Ok(Value::Number(f64::from(n))),
            },
        }
    }
}

/// Whether a number that was read as zero was meant to be another.
fn says_more_than_zero(text: &str) -> bool {
    let digits = text.split(['e', 'E']).next().unwrap_or_default();
    digits.contains(|c: char| ('1'..='9').contains(&c))
}

/// The values of all parameters of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
#[serde(transparent)]
pub struct Parameters(BTreeMap<String, Value>);

impl Parameters {
    /// The defaults of `known`, changed by `assignments` of the form `name=value`.
    ///
    /// # Errors
    /// An assignment that is malformed, of an unknown parameter, the second of one, or of a value that is not allowed.
    pub fn new(known: &[Parameter], assignments: &[String]) -> Result<Self, Error> {
        let mut values = BTreeMap::new();
        for p in known {
            values.insert(p.name.to_owned(), p.parse(p.default)?);
        }
        let mut assigned = BTreeSet::new();
        for assignment in assignments {
            let Some((name, text)) = assignment.split_once('=') else {
                return Err(Error(format!("\"{assignment}\" is not of the form name=value")));
            };
            let Some(p) = known.iter().find(|p| p.name == name) else {
                return Err(Error::unknown("parameter", name, known.iter().map(|p| p.name)));
            };
            if !assigned.insert(name) {
                return Err(Error(format!("parameter {name} is set twice")));
            }
            values.insert(name.to_owned(), p.parse(text)?);
        }
        Ok(Self(values))
    }

    /// The value of a parameter, or its default.
    ///
    /// # Errors
    /// The value is of another type.
    pub fn read<T: Typed>(&self, of: Parameter) -> Result<T, Error> {
        let value = match self.0.get(of.name) {
            Some(value) => value.clone(),
            None => of.parse(of.default)?,
        };
        let refused = || Error(format!("parameter {}: {value}; allowed: {}", of.name, of.domain));
        T::typed(&value).ok_or_else(refused)
    }

    /// Where these differ from `other`: the name and both values.
    #[must_use]
    pub fn differences(&self, other: &Self) -> Vec<(String, String, String)> {
        let names: BTreeSet<&String> = self.0.keys().chain(other.0.keys()).collect();
        let differing = names.into_iter().filter(|n| self.0.get(*n) != other.0.get(*n));
        differing.map(|n| (n.clone(), self.value_text(n), other.value_text(n))).collect()
    }

    /// A numeric parameter; NaN if the case has none of this name.
    #[must_use]
    pub fn number(&self, of: Parameter) -> f64 {
        match self.0.get(of.name) {
            Some(Value::Number(x)) => *x,
            _ => f64::NAN,
        }
    }

    /// A boolean parameter.
    #[must_use]
    pub fn boolean(&self, of: Parameter) -> bool {
        matches!(self.0.get(of.name), Some(Value::Boolean(true)))
    }

    /// Whether the choice `name` is `word`.
    #[must_use]
    pub fn is(&self, of: Parameter, word: &str) -> bool {
        matches!(self.0.get(of.name), Some(Value::Choice(c)) if c == word)
    }

    /// The value as text; empty if the case has none of this name.
    #[must_use]
    pub fn text(&self, of: Parameter) -> String {
        self.value_text(of.name)
    }

    fn value_text(&self, name: &str) -> String {
        self.0.get(name).map_or_else(String::new, Value::to_string)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATIO: Parameter = Parameter {
        name: "poisson_ratio",
        unit: "-",
        default: "0.3",
        domain: Domain::Number { least: 0.0, most: 0.5, below: true },
        meaning: "",
    };

    #[test]
    fn every_bad_value_names_the_parameter_and_its_range() {
        for bad in ["nan", "inf", "1e400", "-0.1", "0.5", "x", ""] {
            let text = RATIO.parse(bad).unwrap_err().to_string();
            assert!(text.contains("poisson_ratio"), "{text}");
            assert!(text.contains("0 to below 0.5"), "{text}");
        }
        assert_eq!(RATIO.parse("0.499").unwrap(), Value::Number(0.499));
        let tiny = RATIO.parse("1e-400").unwrap_err().to_string();
        assert!(tiny.contains("too small to be told from 0"), "{tiny}");
        for zero in ["0", "-0", "0e5", "-0.0e-400"] {
            let Ok(Value::Number(x)) = RATIO.parse(zero) else {
                panic!("{zero}");
            };
            assert!(x == 0.0 && x.is_sign_positive(), "{zero}");
        }
    }

    #[test]
    fn assignments_override_defaults_and_unknown_names_are_refused() {
        let p = Parameters::new(&[RATIO], &["poisson_ratio=0.4".into()]).unwrap();
        assert_eq!(p.number(RATIO), 0.4);
        let unknown = Parameters::new(&[RATIO], &["nu=0.4".into()]).unwrap_err();
        assert!(unknown.to_string().contains("allowed: poisson_ratio"));
        assert!(Parameters::new(&[RATIO], &["nu".into()]).is_err());
        let twice = ["poisson_ratio=0.4".into(), "poisson_ratio=0.4".into()];
        let twice = Parameters::new(&[RATIO], &twice).unwrap_err();
        assert!(twice.to_string().contains("poisson_ratio is set twice"));
    }
}
