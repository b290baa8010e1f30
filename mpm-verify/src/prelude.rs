//! Names that cases share.

pub(crate) use crate::accuracy::fit_order;
pub(crate) use crate::case::Tier::{Long, Nightly, Pr, Quick};
pub(crate) use crate::case::{Begin, Case, Family, FieldView, Plan};
pub(crate) use crate::check::{Check, Finding};
pub(crate) use crate::demand::{CheckOf, Demand, Held, Over, Quantity, SLACK, same_but, same_but_scheme};
pub(crate) use crate::draw::style::{LEVEL_DASHES, history, series};
pub(crate) use crate::draw::{Dash, FieldFigure, FieldPanel, Marker, ReferenceLine, Series, draw_fields, signed};
pub(crate) use crate::error::Error;
pub(crate) use crate::exact::{Exact, Material};
pub(crate) use crate::figure::{Figure, Panel, sampled};
pub(crate) use crate::gallery::Gallery;
pub(crate) use crate::job::{Job, Row, Snapshot, row};
pub(crate) use crate::metric::{Metric, Sweep, error, metrics, names, value};
pub(crate) use crate::parameter::{
    Domain, Parameter, ParameterSet, Parameters, choices, flag, number, parameters, real, whole,
};
pub(crate) use crate::probe::PointProbe;
pub(crate) use crate::problem::{self, Begun, Columns, Phase, Problem, Rows};
pub(crate) use crate::record::{Discretisation, Record, Status, WorkDone};
pub(crate) use crate::results::{
    BASIS, CELLS, CHANGED, Column, Format, LEVEL, Label, PAIR, ResultTable, SCHEME, SET, SHORT, fixed, is_flip, order,
    percent, scientific, share, word,
};
pub(crate) use crate::scheme::BasisName::{Bspline2, Bspline3, Gimp, Linear};
pub(crate) use crate::scheme::RemedyName::{FbarConsistent, FbarRate, FbarRecursive, FbarTotal};
pub(crate) use crate::scheme::SpaceName::{Equal, Ppp, TwoGrid};
pub(crate) use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, SpaceName, TransferName};
pub(crate) use crate::setup::{Run, Setup};
pub(crate) use crate::sketch::Sketch;
pub(crate) use crate::spec::{Level, RunSpec};
pub(crate) use crate::statistics::{checkerboard, fit_line, growth, half_period, mean, rms};
pub(crate) use crate::table::Table;
pub(crate) use mpm_core::contact::{Barrier, Friction, RigidContact, RigidFace};
pub(crate) use mpm_core::explicit::courant_time_step;
pub(crate) use mpm_core::explicit::transfer::Flip;
pub(crate) use mpm_core::implicit::Stabilisation;
pub(crate) use mpm_core::material::{
    Hencky, HenckyJ2, ImprovedHencky, JaumannUpdate, Law, NeoHookean, NewtonianFluid, SharedLaw, Strength, Viscous,
};
pub(crate) use mpm_core::poro::{Conductivity, Water};
pub(crate) use mpm_core::stage::{Amplitude, BodyForce, End, Gravity, RigidNodes, Wall, WallKind};
pub(crate) use mpm_core::{Axis, Bodies, Error as Fault, Field, Grid, Part, Particles, Saved, Scene, Side, Simulation};
pub(crate) use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, SMatrix, Vector3};
pub(crate) use serde::{Deserialize, Serialize};
pub(crate) use std::collections::BTreeMap;
pub(crate) use std::f64::consts::{PI, SQRT_2, TAU};
pub(crate) use std::ops::RangeInclusive;
pub(crate) use std::sync::{Arc, LazyLock};
