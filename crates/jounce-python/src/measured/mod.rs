//! Recordings of tests: conversion of arrays to recordings of `jounce-measure`, and of its results
//! to arrays.

pub mod contact;
pub mod decays;
pub mod hammer;
pub mod modes;
pub mod power;
pub mod recording;
pub mod segments;
pub mod spectra;
