// Export of the design: spec, table, pictures, and the commands that give the same response.

import { type ResponseResult, isStable } from "./branches";
import { Chart } from "./chart";
import type { Drawing } from "./drawing";
import type { Head } from "./frame";
import type { Drawn } from "./print";
import type { Response } from "./response";
import { colour } from "./theme";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Tables of the tabs: of the response by default. */
export type Tables = Record<string, () => string | undefined>;

export class Exports {
    private readonly dialog = find<HTMLDialogElement>("export-dialog");
    private spec = "";
    private stem = "harvester";
    private link = "";

    constructor(private readonly response: Response, private readonly drawing: Drawing, private readonly tables: Tables) {
        find("export-spec").onclick = () => save(`${this.stem}.toml`, "application/toml", this.spec);
        find("export-table").onclick = () => {
            const content = this.table();
            if (content) save(`${this.stem}-${this.name === "response" ? "branches" : this.name}.csv`, "text/csv", content);
        };
        find("export-drawing").onclick = () => save(`${this.stem}.svg`, "image/svg+xml", this.drawing.svg);
        find("export-picture").onclick = () => this.picture();
        find("export-vectors").onclick = () => this.vectors();
        find("export-copy-link").onclick = () => copyText(this.link);
        find("export-copy-command").onclick = () => copyText(find("export-link").textContent!);
    }

    /** Opens the dialog with the data of the server. */
    open(head: Head, file: string): void {
        this.spec = head.spec;
        this.link = head.link;
        find("export-copied").textContent = "";
        this.stem = file.split(/[\\/]/).pop()!.replace(/\.[^.]*$/, "") || "harvester";
        find("export-link").textContent = `jounce explore --link '${head.link}'`;
        find("export-shell").textContent = head.shell;
        find("export-python").textContent = head.python;
        const hasChart = this.charts.length > 0;
        find<HTMLButtonElement>("export-table").disabled = this.table() === undefined;
        for (const id of ["export-picture", "export-vectors"]) find<HTMLButtonElement>(id).disabled = !hasChart;
        const tab = document.querySelector("[role=tab][aria-selected=true]")!.textContent;
        find("export-shown").textContent = hasChart ? `Table and pictures are those of the tab ${tab}.` : `The tab ${tab} has no chart to export.`;
        if (!this.dialog.open) this.dialog.showModal();
    }

    private get panel(): HTMLElement {
        return document.querySelector<HTMLElement>("[role=tabpanel]:not([hidden])")!;
    }

    /** Name of what is shown, for files. The tab of the design shows the response. */
    private get name(): string {
        const name = this.panel.id.replace("panel-", "");
        return name === "design" ? "response" : name === "shake" ? "excitation" : name;
    }

    /** Charts of the shown tab. */
    private get charts(): Chart[] {
        return Chart.all.filter((chart) => chart.canvas && this.panel.contains(chart.host) && chart.host.checkVisibility());
    }

    private table(): string | undefined {
        const { result } = this.response;
        if (this.name === "response") return result && table(result);
        return this.tables[this.name]?.();
    }

    /** Saves the charts below each other. */
    private picture(): void {
        const canvases = this.charts.map((chart) => chart.canvas!);
        const sheet = document.createElement("canvas");
        [sheet.width, sheet.height] = [Math.max(...canvases.map((own) => own.width)), canvases.reduce((sum, own) => sum + own.height, 0)];
        const ctx = sheet.getContext("2d")!;
        ctx.fillStyle = colour("paper");
        ctx.fillRect(0, 0, sheet.width, sheet.height);
        let top = 0;
        for (const own of canvases) {
            ctx.drawImage(own, 0, top);
            top += own.height;
        }
        sheet.toBlob((blob) => blob && save(`${this.stem}-${this.name}.png`, "image/png", blob));
    }

    private vectors(): void {
        const { charts } = this;
        const name = `${this.stem}-${this.name}.svg`;
        if (charts.length === 1) return saveChart(name, charts[0]);
        let top = 0;
        const parts = charts.map((chart) => {
            const part = (chart.svg(colour("paper")) ?? "").replace("<svg ", `<svg y="${top}" `);
            top += chart.canvas!.height;
            return part;
        });
        const width = Math.max(...charts.map((chart) => chart.canvas!.width));
        save(name, "image/svg+xml", `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${top}" viewBox="0 0 ${width} ${top}">${parts.join("")}</svg>\n`);
    }
}

/** Copies a text, and says in the dialog whether the browser allowed it. */
function copyText(text: string): void {
    const copied = navigator.clipboard?.writeText(text) ?? Promise.reject(new Error("no clipboard"));
    const say = (words: string) => (find("export-copied").textContent = words);
    copied.then(() => say("copied"), () => say("the browser refuses; select the text below"));
}

/** Points of the curves of some charts, named after the axes. */
export function chartTable(charts: Chart[]): string | undefined {
    const rows = charts.flatMap((chart) => chart.points.map(([x, y]) => [...chart.titles, x, y].join(",")));
    return rows.length > 0 ? `x_axis,y_axis,x,y\n${rows.join("\n")}\n` : undefined;
}

/** The columns of `jounce branch --out` that the page has. */
export function table(result: ResponseResult): string {
    const lines = ["branch,period_cycles,parameter,mean_power_w,voltage_rms_v,stable,floquet_max_abs,contacts_per_period,max_penetration_m"];
    result.branches.forEach((branch, k) => {
        const { power, voltage, floquet, penetration } = branch.values;
        branch.x.forEach((x, point) => {
            lines.push([k, branch.period, x, power[point], voltage[point], isStable(branch, point), floquet[point], branch.contacts[point], penetration[point]].join(","));
        });
    });
    return lines.join("\n") + "\n";
}

/** Downloads a chart as vectors, in the colours of the page. */
export function saveChart(name: string, chart: Drawn): void {
    const svg = chart.svg(colour("paper"));
    if (svg) save(name, "image/svg+xml", svg);
}

/** Downloads a file of the page. */
export function save(name: string, type: string, content: string | Blob): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
