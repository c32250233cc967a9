// Export of the design: spec, table, pictures, and the commands that give the same response.

import { type ResponseResult, isStable } from "./branches";
import { Chart } from "./chart";
import type { Drawing } from "./drawing";
import type { Head } from "./frame";
import type { Drawn } from "./print";
import { type LegendEntry, drawLegend, legendHeight } from "./legend";
import type { Response } from "./response";
import { record } from "./recorder";
import { responseLegend } from "./response-legend";
import { colour } from "./theme";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Tables of the tabs: of the response by default. */
export type Tables = Record<string, () => string | undefined>;

export class Exports {
    private readonly dialog = find<HTMLDialogElement>("export-dialog");
    private spec = "";
    private stem = "harvester";
    private link = "";

    constructor(private readonly response: Response, private readonly drawing: Drawing, private readonly tables: Tables, private readonly legends: Record<string, () => LegendEntry[]>) {
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

    /** Legend of the shown tab. */
    private get legend(): LegendEntry[] {
        return this.name === "response" ? responseLegend(this.response) : this.legends[this.name]?.() ?? [];
    }

    /** Saves the charts below each other, with their legend, at the chosen size. */
    private picture(): void {
        const { charts, legend } = this;
        const factor = Number(find<HTMLSelectElement>("export-size").value);
        const canvases = charts.map((chart) => chart.canvas!);
        const sheet = document.createElement("canvas");
        const ctx = sheet.getContext("2d")!;
        const [width, ratio] = [Math.max(...canvases.map((own) => own.width)), devicePixelRatio || 1];
        const below = canvases.reduce((sum, own) => sum + own.height, 0);
        [sheet.width, sheet.height] = [factor * width, Math.ceil(factor * (below + ratio * legendHeight(ctx, legend, width / ratio)))];
        ctx.fillStyle = colour("paper");
        ctx.fillRect(0, 0, sheet.width, sheet.height);
        let top = 0;
        charts.forEach((chart, k) => {
            chart.drawOn(ctx, factor, top);
            top += factor * canvases[k].height;
        });
        ctx.setTransform(factor * ratio, 0, 0, factor * ratio, 0, top);
        drawLegend(ctx, legend, width / ratio);
        sheet.toBlob((blob) => blob && save(`${this.stem}-${this.name}.png`, "image/png", blob));
    }

    /** Saves the charts below each other as vectors, with their legend. */
    private vectors(): void {
        const { charts, legend } = this;
        const [width, ratio] = [Math.max(...charts.map((chart) => chart.canvas!.width)), devicePixelRatio || 1];
        let top = 0;
        const below = (svg: string, height: number) => {
            const part = svg.replace("<svg ", `<svg y="${top}" `);
            top += height;
            return part;
        };
        const parts = charts.map((chart) => below(chart.svg(colour("paper")) ?? "", chart.canvas!.height));
        const sheet = document.createElement("canvas");
        const ctx = sheet.getContext("2d")!;
        [sheet.width, sheet.height] = [width, Math.ceil(ratio * legendHeight(ctx, legend, width / ratio))];
        ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
        if (legend.length > 0) parts.push(below(record(ctx, () => drawLegend(ctx, legend, width / ratio), colour("paper")), sheet.height));
        save(`${this.stem}-${this.name}.svg`, "image/svg+xml", `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${top}" viewBox="0 0 ${width} ${top}">${parts.join("")}</svg>\n`);
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
