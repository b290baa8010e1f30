//! Tests of the solver from outside, as one program.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod averages;
mod basis;
mod bodies;
mod contact;
mod dual;
mod eights;
mod execution;
mod footing;
mod frame;
mod implicit;
mod lattice;
mod laws;
mod loads;
mod mapping;
mod memory;
mod modes;
mod monitor;
mod poro;
mod reach;
mod rest;
mod rigid_nodes;
mod scenes;
mod solver;
mod space;
mod tensors;
mod transfers;
mod walls;
