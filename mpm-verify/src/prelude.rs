//! The names that nearly every case uses.

pub(crate) use crate::case::Tier::{Long, Nightly, Pr, Quick};
pub(crate) use crate::case::{Case, Family, FieldView, Plan};
pub(crate) use crate::check::{Check, Finding};
pub(crate) use crate::demand::{CheckOf, Demand, Over, Quantity, SLACK, same_but_scheme};
pub(crate) use crate::draw::style::{history, series};
pub(crate) use crate::draw::{Chart, Dash, Marker, ReferenceLine, Series};
pub(crate) use crate::error::Error;
pub(crate) use crate::figure::{Figure, Panel, sampled};
pub(crate) use crate::gallery::Gallery;
pub(crate) use crate::job::{Row, Snapshot, row};
pub(crate) use crate::metric::{Metric, Sweep, error, metrics, value};
pub(crate) use crate::parameter::{choices, flag, parameters, real, whole};
pub(crate) use crate::problem::{Columns, Phase, Problem, Rows};
pub(crate) use crate::record::{Discretisation, Record, Status};
pub(crate) use crate::results::{
    CELLS, Column, Label, PAIR, ResultTable, SCHEME, SHORT, fixed, headline, is_flip, order, percent, scientific, share,
};
pub(crate) use crate::scheme::BasisName::{Bspline2, Bspline3, Gimp, Linear};
pub(crate) use crate::scheme::RemedyName::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal};
pub(crate) use crate::scheme::SpaceName::{Equal, Ppp, TwoGrid};
pub(crate) use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, SpaceName, TransferName};
pub(crate) use crate::setup::{Run, Setup};
pub(crate) use crate::sketch::{Shape, Sketch};
pub(crate) use crate::spec::{Level, RunSpec};
pub(crate) use crate::table::Table;
pub(crate) use crate::wanted::Wanted;
pub(crate) use mpm_core::stage::{End, Wall, WallKind};
pub(crate) use mpm_core::{Axis, Body, Field, Grid, Particles, Scene, Side, Simulation};
pub(crate) use serde::{Deserialize, Serialize};
