//! Response over a key: first the branches near those of the previous design, then all branches
//! that `jounce branch` finds.

use crate::session::Session;
use crate::session::blocking::Share;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use crate::session::request::{Request, RequestKind};
use jounce::live::{
    Design, KeySpan, LiveAnalysis, ResponseBifurcation, ResponseBranch, ResponseHistory,
    ResponseOptions, ResponseResult,
};
use jounce::{Control, Error};
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time without slider movement before the fine response begins.
const SLIDER_REST: Duration = Duration::from_millis(120);

/// What a response depends on: pages with the same share its computation.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponseKey {
    design: Arc<Design>,
    span: KeySpan,
    /// Draft or search.
    stage: &'static str,
    options: ResponseOptions,
    history: ResponseHistory,
}

/// Response in an analysis of its own, from which each page adopts it.
#[derive(Debug)]
pub struct SharedResponse {
    analysis: LiveAnalysis,
    id: u64,
    result: ResponseResult,
}

/// Request for a response.
struct ResponseRequest<'s> {
    session: &'s Session,
    id: u64,
    design: Arc<Design>,
    span: KeySpan,
    options: ResponseOptions,
    cancellation: &'s Cancellation,
}

/// Sends the harvester without contact, the coarse and the fine response, then peak and bandwidth.
///
/// # Errors
/// [`RequestFault`]: faults of the range or of the harvester.
pub async fn respond(
    session: &Arc<Session>,
    request: Request,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let id = request.id;
    let RequestKind::Response { span, options } = request.kind.clone() else {
        return Ok(());
    };
    let start_time = Instant::now();
    let (own, over) = (Arc::clone(session), span.clone());
    let begin = move |cancellation: &Cancellation| {
        let design = own.design(&request)?;
        let control = cancellation.control();
        if let Some(first) = own.analysis.first_response(&design, &over, control)? {
            own.send(cancellation, frame(id, "first", &first, start_time));
        }
        Ok(Arc::new(design))
    };
    let begun = session.quick_share().compute(cancellation, begin).await;
    let Some(design) = begun.transpose()? else {
        return Ok(());
    };
    let request = ResponseRequest {
        session,
        id,
        design,
        span,
        options,
        cancellation,
    };
    if !request.send_coarse(start_time).await? {
        return Ok(());
    }
    tokio::select! {
        () = cancellation.stopped() => Ok(()),
        () = tokio::time::sleep(SLIDER_REST) => request.send_fine().await,
    }
}

impl ResponseRequest<'_> {
    /// Sends the coarse response; returns whether it was sent.
    async fn send_coarse(&self, start_time: Instant) -> Result<bool, RequestFault> {
        let (id, span, options) = (self.id, self.span.clone(), self.options.clone());
        let share = self.session.quick_share();
        let compute = move |analysis: &LiveAnalysis, design: &Design, control: &Control| {
            analysis.coarse_response(id, design, &span, &options, control)
        };
        let Some(coarse) = self.shared("coarse", share, compute).await? else {
            return Ok(false);
        };
        self.send(frame(id, "coarse", &coarse.result, start_time))
            .await;
        Ok(true)
    }

    /// Sends the fine response, then peak and bandwidth.
    async fn send_fine(&self) -> Result<(), RequestFault> {
        let start_time = Instant::now();
        let (id, span, options) = (self.id, self.span.clone(), self.options.clone());
        let (host, share) = (
            Arc::clone(&self.session.host),
            self.session.branch_search_share(),
        );
        let search = move |analysis: &LiveAnalysis, design: &Design, control: &Control| {
            let pool = &host.branch_search_pool;
            pool.install(|| analysis.fine_response(id, design, &span, &options, control))
        };
        let Some(fine) = self.shared("fine", share, search).await? else {
            return Ok(());
        };
        self.send(frame(id, "fine", &fine.result, start_time)).await;
        if fine.result.branches.is_empty() {
            return Ok(());
        }
        self.send_bandwidth(fine).await
    }

    async fn send_bandwidth(&self, fine: Arc<SharedResponse>) -> Result<(), RequestFault> {
        let (session, options) = (self.session, self.options.clone());
        let host = Arc::clone(&session.host);
        let measure = move |control: &Control| {
            let pool = &host.branch_search_pool;
            Ok(pool.install(|| fine.analysis.bandwidth(fine.id, &options, control))?)
        };
        let computation = session.host.bandwidths.find_or_start(
            self.key("fine"),
            session.branch_search_share(),
            measure,
        );
        let stage = (self.id, "response", "bandwidth");
        let found = session
            .shared(stage, computation, self.cancellation)
            .await?;
        let Some(bandwidth) = found else {
            return Ok(());
        };
        let mut frame = Frame::new(self.id, "response", "widths");
        if let Some(bandwidth) = bandwidth.as_ref() {
            frame
                .put("peak", json!(bandwidth.peak))
                .put("intervals", json!(bandwidth.intervals))
                .put("width", bandwidth.width);
        }
        self.send(frame).await;
        Ok(())
    }

    /// Waits for a response that is computed from a copy of the data of a page, and stores it;
    /// `None` where the request is cancelled first.
    async fn shared(
        &self,
        stage: &'static str,
        share: Share,
        compute: impl FnOnce(&LiveAnalysis, &Design, &Control) -> Result<ResponseResult, Error>
        + Send
        + 'static,
    ) -> Result<Option<Arc<SharedResponse>>, RequestFault> {
        let (session, id, design) = (self.session, self.id, Arc::clone(&self.design));
        let analysis = session.analysis.fork();
        let work = move |control: &Control| {
            let result = compute(&analysis, &design, control)?;
            Ok(SharedResponse {
                analysis,
                id,
                result,
            })
        };
        let computation = session
            .host
            .responses
            .find_or_start(self.key(stage), share, work);
        let stage = (id, "response", stage);
        let found = session
            .shared(stage, computation, self.cancellation)
            .await?;
        let found = found.filter(|_| !self.cancellation.is_stopped());
        if let Some(found) = &found {
            session.analysis.adopt(id, &found.analysis, found.id)?;
        }
        Ok(found)
    }

    /// Returns what the response depends on; the history is that of the present time.
    fn key(&self, stage: &'static str) -> ResponseKey {
        ResponseKey {
            design: Arc::clone(&self.design),
            span: self.span.clone(),
            stage,
            options: self.options.clone(),
            history: self.session.analysis.history(&self.span.over),
        }
    }

    async fn send(&self, frame: Frame) {
        let session = self.session;
        session.send_unless_stopped(self.cancellation, frame).await;
    }
}

fn frame(id: u64, stage: &str, response: &ResponseResult, start_time: Instant) -> Frame {
    let mut frame = Frame::new(id, "response", stage);
    frame
        .put("over", response.over.as_str())
        .put("unit", response.unit.as_str())
        .put("storage", response.is_storage_voltage)
        .put("patches", response.patches)
        .put("note", json!(response.note))
        .put("budget_note", json!(response.budget_note))
        .put("draft", json!(response.draft))
        .put("ms", 1e3 * start_time.elapsed().as_secs_f64());
    frame.curve("linear", &response.linear);
    for (index, branch) in response.branches.iter().enumerate() {
        put_branch(&mut frame, index, branch);
    }
    let branch =
        |own: &ResponseBranch| json!({ "period": own.period_cycles, "endings": own.endings });
    frame
        .put(
            "branches",
            response.branches.iter().map(branch).collect::<Vec<_>>(),
        )
        .put(
            "bifurcations",
            response
                .bifurcations
                .iter()
                .map(bifurcation)
                .collect::<Vec<_>>(),
        );
    frame
}

fn put_branch(frame: &mut Frame, index: usize, branch: &ResponseBranch) {
    let lists = [
        ("x", &branch.parameter),
        ("power", &branch.mean_power_w),
        ("voltage", &branch.voltage_rms_v),
        ("penetration", &branch.max_penetration_m),
        ("force", &branch.max_contact_force_n),
        ("impact", &branch.max_impact_velocity_m_s),
        ("displacement", &branch.displacement_peak_m),
        ("floquet", &branch.floquet_max_abs),
        ("error", &branch.line_error),
    ];
    for (name, list) in lists {
        frame.array(&format!("{index}.{name}"), list.iter().copied());
    }
    let contacts = branch.contacts.iter().map(|contacts| *contacts as f64);
    frame.array(&format!("{index}.contacts"), contacts);
}

fn bifurcation(own: &ResponseBifurcation) -> Value {
    json!({
        "branch": own.branch, "kind": own.kind, "x": own.parameter, "error": own.parameter_error, "power": own.mean_power_w,
        "voltage": own.voltage_rms_v, "penetration": own.max_penetration_m, "floquet": own.floquet_max_abs,
        "force": own.max_contact_force_n, "impact": own.max_impact_velocity_m_s, "displacement": own.displacement_peak_m,
        "contacts": own.contacts,
    })
}
