// The page: one design, one socket, and the views that follow them.

import { Axes } from "./axes";
import { Basins } from "./basins";
import { resultOf } from "./branches";
import { Controls } from "./controls";
import { Design, fromFragment, toFragment } from "./design";
import { Drawing } from "./drawing";
import { Exports } from "./exports";
import type { Frame } from "./frame";
import { Load } from "./load";
import { Orbit } from "./orbit";
import { Pins } from "./pins";
import { Requests } from "./requests";
import { Response } from "./response";
import { Shake } from "./shake";
import { Tabs } from "./tabs";
import { Theme } from "./theme";
import { Wire } from "./wire";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Time without changes after which the address is updated. */
const ADDRESS_RESTS_MS = 250;

const wire = new Wire();
const design = new Design();
const controls = new Controls(find("groups"), find("faults"), design);
const drawing = new Drawing(find("side"), find("close"), controls, design);
const response = new Response(find("chart-response"), find("readout"));
const orbit = new Orbit();
const axes = new Axes(controls);
const load = new Load(wire, controls, design);
const basins = new Basins(wire, design);
const shake = new Shake(wire, controls, design, () => find("tab-shake").click());
const exports = new Exports(response, drawing);
const pins = new Pins(find("pins"), response, design);
const status = find("status");
let file = "";
let begun = false;

const say = (words: string) => {
    if (status.textContent !== words) status.textContent = words;
};

const requests = new Requests(wire, design, axes, response, {
    say,
    orbit: (frame: Frame) => orbit.take(frame),
    fault: (faults) => {
        controls.tell(faults);
        document.body.classList.toggle("faulty", faults.length > 0);
    },
});

// A browser is slow to set an address, and limits their rate: one when the design rests.
let resting = 0;
const address = () => {
    clearTimeout(resting);
    if (!begun) return;
    history.replaceState(null, "", `#${toFragment(design.pairs, axes.view)}`);
};
addEventListener("pagehide", address);
const remember = () => {
    clearTimeout(resting);
    resting = setTimeout(address, ADDRESS_RESTS_MS);
    find<HTMLButtonElement>("undo").disabled = !design.canUndo;
    find<HTMLButtonElement>("redo").disabled = !design.canRedo;
    find<HTMLButtonElement>("reset").disabled = design.overrides.size === 0;
};

design.onChange = (moving) => {
    requests.change(performance.now());
    if (!moving) remember();
};
axes.onChange = () => {
    response.swept = [];
    requests.change(performance.now());
    remember();
};
axes.onWrong = (message) => controls.tell([{ key: "", line: 0, message }]);
response.onChoose = (place) => requests.orbit(place);

wire.on("hello", ({ head }) => {
    file = head.file;
    find("file").textContent = file.split(/[\\/]/).pop()!;
    document.title = `${find("file").textContent} – jounce explore`;
    if (!begun) {
        const kept = fromFragment(location.hash);
        design.begin(kept?.pairs ?? head.set);
        if (kept?.view) axes.set(kept.view);
        begun = true;
    }
    requests.change(performance.now());
});
wire.on("design", (frame) => {
    const { head } = frame;
    if (head.stage === "fault") return requests.designFault(head);
    controls.take(head.controls);
    drawing.take(head.drawing);
    axes.offer();
    load.offer();
    shake.offer();
    requests.designTaken();
    remember();
});
wire.on("response", (frame) => {
    if (frame.head.stage === "widths") return response.takeWidths(frame.head);
    if (frame.head.stage === "fault") return requests.responseFault(frame.head);
    const { view } = axes;
    if (view) response.range = [view.from, view.to];
    requests.responseTaken(frame.head, resultOf(frame));
});
wire.on("file", () => {
    say("the file has changed");
    requests.change(performance.now());
});
wire.on("export", ({ head }) => {
    if (head.stage !== "fault") exports.open(head, file);
});
wire.onOpen = () => {
    find("lost").hidden = true;
    say("connected");
};
wire.onLost = () => {
    find("lost").hidden = false;
    say("the server has stopped");
    requests.forget();
};

const act: Record<string, () => void> = {
    undo: () => design.undo(),
    redo: () => design.redo(),
    reset: () => design.reset(),
    pin: () => pins.add(),
    share: () => {
        address();
        navigator.clipboard?.writeText(location.href).then(() => say("the link was copied"), () => say("copy the link from the address bar"));
    },
    export: () => axes.view && wire.ask("export", { set: design.pairs, ...axes.view }),
};
for (const [id, run] of Object.entries(act)) find(id).onclick = run;
const theme = new Theme(find("theme"), () => {
    response.draw();
    orbit.redraw();
    load.redraw();
    basins.redraw();
    shake.redraw();
});

find<HTMLSelectElement>("quantity").onchange = (event) => {
    response.quantity = (event.target as HTMLSelectElement).value as typeof response.quantity;
    response.draw();
};
find<HTMLInputElement>("log").onchange = (event) => {
    response.log = (event.target as HTMLInputElement).checked;
    response.draw();
};
find("sweep").onclick = () => requests.sweep(find("sweep"));
new Tabs(document.querySelector<HTMLElement>("[role=tablist]")!, (id) => {
    if (id === "tab-response") response.chart.redraw();
    if (id === "tab-load") load.run();
    if (id === "tab-basins") basins.redraw();
    if (id === "tab-shake") shake.redraw();
});

addEventListener("keydown", (event) => {
    const typing = event.target instanceof HTMLInputElement && event.target.type !== "range";
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z" && !typing) {
        event.preventDefault();
        (event.shiftKey ? act.redo : act.undo)();
    } else if (!event.ctrlKey && !event.metaKey && !event.altKey && !typing && !(event.target instanceof HTMLSelectElement)) {
        const run = { p: act.pin, l: act.share, e: act.export, t: () => theme.toggle() }[event.key];
        run?.();
    }
});
wire.connect();
