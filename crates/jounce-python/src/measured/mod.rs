//! Recordings of tests: conversion of arrays to recordings of the library, and of its results to
//! arrays.

pub mod contact;
pub mod frf;
pub mod modes;
pub mod power;
pub mod recording;
pub mod segments;
pub mod spectra;
