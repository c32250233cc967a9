//! Parts of options and results, and the types of a spec, a table, a figure and a recording.

pub use crate::basins::{AttractorResult, FailedStart, StartPoint};
pub use crate::bifurcations::BifurcationCurve;
pub use crate::branch::{
    Bifurcation, Branch, BranchPoint, BranchQuantity, HalfPowerBandwidth, NotProved, OrbitMethod,
    Termination, TerminationReason, band_limit_text,
};
pub use crate::check::DriveIssue;
pub use crate::contact::{FixedLawResult, ForceTableResult, HitResult};
pub use crate::design::DesignJournal;
pub use crate::diagram::{DiagramDirection, DiagramJournal, DiagramPoint, SectionPoint};
pub use crate::ensemble::{EnsembleDevice, EnsemblePatch, EnsembleStop, VoltageSpectrum};
pub use crate::frf::FrfResponse;
pub use crate::measured_frf::{FrfEstimator, FunctionParts, MeasuredResponse, PerG};
pub use crate::measured_modes::{ComplexValues, MeasuredMode};
pub use crate::modes::{BeamShapes, ModeResult, PatchCoupling, PlateShapes, PointShape};
pub use crate::power::{OrderAmplitude, PowerRecord};
pub use crate::read::{ChannelResult, Conversion, RecordingResult, ShapeResult};
pub use crate::record::{file_sha256, recorded_inputs, text_sha256};
pub use crate::recording::{ChannelList, ChosenChannel, UsesChannels};
pub use crate::rig::BaseMotion;
pub use crate::run::{History, HistorySamples, LoadResult, PatchResult, PointResult};
pub use crate::segments::SegmentResult;
pub use crate::sensitivity::{FailedKey, KeyDerivative, KeySensitivity, OrbitGrazing, OrbitResult};
pub use crate::spectra::OrderPeak;
pub use crate::study::{Shard, StudyStatus};
pub use crate::sweep::{SweepOrder, SweepPoint};
pub use impact_harvester_2019::Claim;
pub use jounce_analysis::run::{ChargeResult, DeviceResult, RectifiedResult, StopResult, Warning};
pub use jounce_analysis::study::StudyError;
pub use jounce_analysis::{
    AttractorKind, AttractorTrack, BandInterval, BandLimit, BifurcationCurvePoint, BranchKind,
    CurveKind, GridError, IntervalEdge, PowerPeak, TrackPoint, Transition,
};
pub use jounce_analysis::{IntervalOver, Journal, Member, SweepDirection};
pub use jounce_data::read::RawChannel;
pub use jounce_data::recording::{
    Channel, ChannelError, Grid, Issue, Over, Quantity as MeasuredQuantity,
};
pub use jounce_design::{
    AllowedLimit, BestDesign, DesignBefore, DesignError, DesignOutcome, FreeValue, FrontPoint,
    Improvement, Journaled, LimitResult, NearestFold, NoiseLimit, NoisePower, OnImprovement,
    PowerBand, Quantile, Robustness, SearchEnd, SobolIndex, TracePoint,
};
pub use jounce_experiment::draw::PulseFigure;
pub use jounce_experiment::fit::{
    FitError, FitResult as FitEstimate, FittedCurve, FittedDeviation, FittedFeature, FittedKey,
};
pub use jounce_experiment::segmentation::{
    Candidate, MAX_PERIOD_CYCLES, MergeReason, MergedChange,
};
pub use jounce_identification::contact::AllowedLaws;
pub use jounce_io::store::{
    check_file, check_folder, reason as system_reason, unreadable, unwritable_folder,
    write as write_file,
};
pub use jounce_io::table::{
    Column, Manifest, Record, RecordedInput, StoredTable, TableDifference, Values,
};
pub use jounce_model::exchange::{MatrixSet, NameKind, Names};
pub use jounce_model::linear::{
    Coupling, Density, RandomLoad, RandomPatch, RandomPoint, RandomStop,
};
pub use jounce_plot::{Drawing, PictureDifference, PictureError, StoredPicture};
pub use jounce_signal::spectral::HitWarning;
pub use jounce_signal::{Samples, SignalError, Spectrum, Window};
pub use jounce_sparse::MatrixEntries;
pub use jounce_spec::material::{Active, Material};
pub use jounce_spec::starter::Starter;
pub use jounce_spec::{Fault, Faults, KeyRange, NumericKey, Quantity, is_unit, quantity_range};
