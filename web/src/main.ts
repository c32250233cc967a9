// The page: one design, one socket, and the views that follow them.

import { Address } from "./address";
import { Axes } from "./axes";
import { Band } from "./band";
import { Basins } from "./basins";
import { described, resultOf } from "./branches";
import { Chart } from "./chart";
import { Controls } from "./controls";
import { Design } from "./design";
import { Drawing } from "./drawing";
import { acceptDrops } from "./drops";
import { Exports, chartTable } from "./exports";
import { keepFocus } from "./focus";
import type { Fault, Frame, Head } from "./frame";
import { Linked } from "./linked";
import { Load } from "./load";
import { Measured } from "./measured";
import { Modes } from "./modes";
import { Orbit } from "./orbit";
import { Pins } from "./pins";
import { OperatingOrbit } from "./operating-orbit";
import { OperatingPoint } from "./operating";
import { preparePrints } from "./print";
import { Quantities } from "./quantities";
import { Readout } from "./readout";
import { Requests } from "./requests";
import { Response } from "./response";
import { Save } from "./save";
import { Search } from "./search";
import { SelectedValue } from "./selected-value";
import { Selection } from "./selection";
import { Shake } from "./shake";
import { shortcuts } from "./shortcuts";
import { type OrbitSource, ShownOrbit } from "./shown-orbit";
import { Strain, strainLimit } from "./strain";
import { Tabs } from "./tabs";
import { Theme } from "./theme";
import { Wire } from "./wire";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Density of the noise of a drive. */
const NOISE = /^drive\.[^.]+\.psd$/;

const design = new Design();
const wire = new Wire(design);
const controls = new Controls(find("groups"), find("faults"), design);
const fault = (source: string, faults: Fault[]) => {
    controls.tell(source, faults);
    if (source === "design") document.body.classList.toggle("faulty", faults.length > 0);
};
const drawing = new Drawing(find("side"), find("close"), controls, design);
const response = new Response(find("chart-response"), new Readout(find("readout"), find("note"), find("bifurcations-title"), find("bifurcations")), design);
const orbit = new Orbit();
const axes = new Axes(controls);
const modes = new Modes(wire, design);
const load = new Load(wire, controls, design);
const shownOrbit = new ShownOrbit(design);
const basins = new Basins(wire, design, shownOrbit);
const search = new Search(wire, controls, design, response);
const shake = new Shake(wire, controls, design, () => find("tab-shake").click());
acceptDrops(async (file, target) => {
    const isOnResponse = find("response-view").contains(target);
    if (!isOnResponse || !(await measured.dropped(file))) shake.dropped(file);
});
const exports = new Exports(response, drawing, {
    load: () => load.table(),
    basins: () => basins.table(),
    excitation: () => chartTable(Chart.all.filter(({ host }) => find("panel-shake").contains(host))),
}, { load: () => load.legend(), basins: () => basins.legend() });
const save = new Save(wire, design);
/** What the export is requested for. */
let wanted: "export" | "save" | "link" = "export";
const status = find("status");
let file = "";

const say = (words: string) => {
    if (status.textContent !== words) status.textContent = status.title = words;
};
/** Replies to an action of the user. No result replaces it; it stays until the next action. */
const replied = find("reply");
const reply = (words: string) => (replied.textContent = replied.title = words);
for (const action of ["pointerdown", "keydown"]) addEventListener(action, () => reply(""), true);
const measured = new Measured(response);
const strain = new Strain(wire, response, reply);
const quantities = new Quantities(controls, (quantity) => {
    response.quantity = quantity;
    response.draw();
    measured.mark();
    strain.show();
    remember();
});
const pins = new Pins(find("pins"), response, design, reply);
const point = new OperatingPoint(wire, design, { words: find("operating-words"), warnings: find("operating-warnings"), safety: find("operating-safety"), stop: find<HTMLButtonElement>("operating-stop") });
const selectedValue = new SelectedValue(response, controls, design);
const selection = new Selection(wire, response, point);
const band = new Band(wire, design, response, selection, search.problem.tolerance);

const requests = new Requests(wire, design, axes, response, {
    say,
    response: () => {
        selection.follow();
        if (response.following) operatingOrbit.show();
    },
    orbit: (frame: Frame, of: OrbitSource) => {
        orbit.take(frame, of.at, () => design.isOld(of));
        shownOrbit.take(frame.head, of);
        selection.computed(frame.head, of);
        remember();
        response.strainLimit = strainLimit(frame.head);
        response.draw();
        operatingOrbit.orbitTaken();
    },
    fault,
    room: () => drawing.requestRoom(),
});
drawing.onRoom = () => requests.redraw();

const operatingOrbit = new OperatingOrbit({ axes, basins, design, orbit, point, requests, response, selection, shown: shownOrbit, wire });

const remember = () => {
    address.change();
    find<HTMLButtonElement>("undo").disabled = !design.canUndo;
    find<HTMLButtonElement>("redo").disabled = !design.canRedo;
    find<HTMLButtonElement>("reset").disabled = design.overrides.size === 0;
};

/** Marks what belongs to the design before, and requests what belongs to the present one. */
const changed = () => {
    for (const source of ["link", "link-axis", "link-design", "link-response"]) fault(source, []);
    linked.drop("orbit");
    for (const view of [point, modes, load, basins, shake, search, orbit]) view.mark();
    operatingOrbit.designChanged();
    requests.change(performance.now());
};
design.onChange = (moving) => {
    changed();
    if (!moving) remember();
};
axes.onChange = () => {
    place();
    requests.change(performance.now());
    remember();
};
response.onChoose = (chosen, parameter) => {
    linked.drop("orbit");
    selection.chosen();
    remember();
    find("operating-show").hidden = false;
    requests.orbit(response.orbitSource(chosen, parameter));
};
basins.onPick = (place) => {
    selection.pick(place);
    find("operating-show").hidden = false;
    operatingOrbit.request(place);
};
basins.onPlane = () => remember();
basins.onTake = () => requests.compareAgain(shownOrbit.of);
response.onMove = (value, moving) => response.result && design.set(response.result.over, controls.words(response.result.over, value), moving);
response.words = (key) => controls.title(key);

/** Shows the present value of the key of the response, and the orbit there. */
const place = () => {
    response.at = response.result && controls.find(response.result.over)?.value;
    selection.follow();
};
point.onChange = () => {
    const { attractor } = point;
    if (attractor) response.attractorPeriod = attractor.period_cycles;
    requests.searchAgain();
    selection.follow();
    operatingOrbit.show();
};
selection.onOperating = () => band.follow();
selection.onMove = ({ parameter, ...place }) => requests.orbit(response.orbitSource(place, parameter));

wire.on("hello", ({ head }) => {
    file = head.file;
    find("file").textContent = file.split(/[\\/]/).pop()!;
    document.title = `${find("file").textContent} – jounce explore`;
    address.begin(head);
    requests.change(performance.now());
});
wire.on("design", ({ head }, request) => {
    if (head.stage === "fault") return designFault(head);
    const asked = new Map<string, string>(request.body.set);
    controls.take(head.controls, head.optional, (key) => design.overrides.get(key) === asked.get(key));
    drawing.take(head.drawing);
    const unknown = axes.offer();
    if (unknown) fault("link-axis", [{ key: "", line: 0, message: `this design has no number ${unknown}, which the link puts on the axis` }]);
    quantities.offer();
    load.offer();
    shake.offer();
    basins.designTaken(controls.all.find(({ key }) => key.startsWith("stop."))?.key.split(".")[1]);
    place();
    linked.reached("design");
    requests.designTaken(head.drive_frequency_hz !== null);
    remember();
    if (requests.isResponseShown) linked.reached("response");
    // The drawing follows a moving slider; the rest waits for the design to which it moves.
    if (request.design !== design.signature) return;
    for (const view of [modes, search]) view.designTaken();
    kindOfDrive(head.drive_frequency_hz === null);
    point.mark();
    point.designTaken(head.drive_frequency_hz, controls.all.some(({ key }) => NOISE.test(key)));
    operatingOrbit.show();
});
/** A link with keys that this spec does not have: the other keys are shown, with a message. */
const designFault = (head: Head) => {
    const unknown = new Set((head.faults as Fault[]).map(({ key }) => key));
    const known = design.pairs.filter(([key]) => !unknown.has(key));
    if (controls.all.length > 0 || known.length === design.pairs.length) return requests.designFault(head);
    fault("link", head.faults);
    design.begin(known);
    requests.designFault({ ...head, faults: [] });
    requests.change(performance.now());
};
/** Noise, shocks and free motion have no periodic orbits: the page shows the time history under the drives of the spec. */
let shaken = "";
const kindOfDrive = (aperiodic: boolean) => {
    document.body.classList.toggle("aperiodic", aperiodic);
    const reason = aperiodic ? "Response, Load and Basins need periodic motion; the drives of this spec have no common period." : "";
    if (find("tabs-words").textContent !== reason) find("tabs-words").textContent = reason;
    find("tabs-words").hidden = !aperiodic;
    search.problem.periodic = !aperiodic;
    if (tabs.disable(aperiodic ? ["tab-response", "tab-load", "tab-basins"] : [], reason)) find("tab-shake").click();
    if (!aperiodic || shaken === design.signature) return;
    shaken = design.signature;
    operatingOrbit.clear("No periodic orbit");
    shake.ofSpec();
};
shake.onSpec = (words, warnings, request) => request.design === design.signature && point.runTaken(`Under ${words}`, warnings);
// A design that settles late: its run from the start of the spec is the first picture.
point.onSlow = () => shake.offerSpec();
wire.on("response", (frame, request) => {
    if (frame.head.stage === "progress") return requests.progress(frame.head);
    if (frame.head.stage === "widths") return response.takeWidths(frame.head);
    if (frame.head.stage === "fault") return requests.responseFault(frame.head);
    response.range = [request.body.from, request.body.to];
    response.at = controls.find(frame.head.over)?.value;
    requests.responseTaken(frame.head, resultOf(frame, request));
    orbit.mark();
    pins.mark();
    measured.mark();
    strain.show();
    quantities.name("voltage", described("voltage", response.result!).words);
    if (frame.head.stage === "fine") linked.reached("response");
});
wire.on("file", () => {
    reply(save.takeChange() ? `saved as ${find("file").textContent}` : "the file has changed");
    design.fileChanged();
    search.fileChanged();
    requests.forgetDesign();
    changed();
});
wire.on("export", ({ head }) => {
    if (head.stage === "fault") return fault("export", head.faults);
    fault("export", []);
    if (wanted === "save") save.open(head, file);
    else if (wanted === "link") copy(head.link);
    else exports.open(head, file);
});
wire.onOpen = () => {
    find("lost").hidden = true;
    say("connected");
};
wire.onLost = (full) => {
    find("lost").hidden = false;
    find("lost-words").textContent = full
        ? "The server has too many open pages. Close one; this page then connects."
        : "The server has stopped. Start jounce explore again; this page then reconnects.";
    say(full ? "too many pages are open" : "the server has stopped");
    for (const view of [requests, selection, operatingOrbit, point, modes, load, basins, shake, search, band]) view.forget();
};

const act: Record<string, () => void> = {
    undo: () => design.undo(),
    redo: () => design.redo(),
    reset: () => design.reset(),
    pin: () => pins.add(),
    share: () => exporting("link"),
    export: () => exporting("export"),
    save: () => exporting("save"),
    use: () => selectedValue.use(),
    keys: () => find<HTMLDialogElement>("keys-dialog").showModal(),
};
const exporting = (purpose: typeof wanted) => {
    wanted = purpose;
    // A link has the motion of the selected orbit.
    requests.whenOrbitShown(() => axes.view && wire.ask("export", { set: design.pairs, page: linked.pairs, ...axes.view }));
};
/** Copies a link; where the browser refuses, the export shows it. */
const copy = (link: string) => {
    const copied = navigator.clipboard?.writeText(link) ?? Promise.reject(new Error("no clipboard"));
    copied.then(() => reply("the link was copied; elsewhere: jounce explore --link LINK"), () => exporting("export"));
};
for (const [id, run] of Object.entries(act)) find(id).onclick = run;
const theme = new Theme(find("theme"), () => {
    response.draw();
    for (const view of [orbit, load, basins, shake]) view.redraw();
});
preparePrints(theme, () => [...Chart.all, orbit.motion], () => {
    find("printed-design").textContent = design.pairs.map(([key, value]) => `${key} = ${value}`).join("; ");
});

response.chart.onZoom = (byUser) => {
    find("zoom-tools").hidden = !response.chart.isZoomed;
    if (byUser) linked.drop("zoom");
    remember();
};
find("zoom-out").onclick = () => response.chart.unzoom();
find("zoom-range").onclick = () => {
    const [from, to] = response.chart.visible;
    if (!axes.view) return;
    axes.change({ over: axes.view.over, from, to });
};
find<HTMLInputElement>("log").onchange = (event) => {
    response.log = (event.target as HTMLInputElement).checked;
    response.draw();
    remember();
};
for (const [id, name] of [["grazings", "grazings"], ["long-periods", "longPeriods"]] as const) {
    find<HTMLInputElement>(id).onchange = (event) => {
        response[name] = (event.target as HTMLInputElement).checked;
        response.draw();
        requests.searchAgain();
        remember();
    };
}
find("sweep").onclick = () => requests.sweep(find("sweep"));
const tabs = new Tabs(document.querySelector<HTMLElement>("[role=tablist]")!, (id) => {
    // One response: the chart moves to the tab that shows it.
    if (id === "tab-response" || id === "tab-design") find(id === "tab-design" ? "design-chart" : "response-chart").append(find("response-view"));
    if (id === "tab-response") response.chart.redraw();
    if (id === "tab-design") search.show();
    if (id === "tab-modes") modes.run();
    if (id === "tab-load") load.run();
    if (id === "tab-basins") basins.redraw();
    if (id === "tab-shake") shake.redraw();
    remember();
});
const linked = new Linked({ basins, quantities, response, selection, tabs }, (stage, faults) => fault(`link-${stage}`, faults));
const address = new Address({ axes, controls, design, linked, requests });

keepFocus();
shortcuts({ ...act, theme: () => theme.toggle() });
wire.connect();
