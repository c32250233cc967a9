// Export of the design: spec, table, pictures, and the commands that give the same response.

import { type ResponseResult, isStable } from "./branches";
import type { Drawing } from "./drawing";
import type { Head } from "./frame";
import type { Drawn } from "./print";
import type { Response } from "./response";
import { colour } from "./theme";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Exports {
    private readonly dialog = find<HTMLDialogElement>("export-dialog");
    private spec = "";
    private stem = "harvester";

    constructor(private readonly response: Response, private readonly drawing: Drawing) {
        find("export-spec").onclick = () => save(`${this.stem}.toml`, "application/toml", this.spec);
        find("export-table").onclick = () => {
            if (this.response.result) save(`${this.stem}-branches.csv`, "text/csv", table(this.response.result));
        };
        find("export-drawing").onclick = () => save(`${this.stem}.svg`, "image/svg+xml", this.drawing.svg);
        find("export-picture").onclick = () => this.picture();
        find("export-vectors").onclick = () => saveChart(`${this.stem}-response.svg`, this.response.chart);
    }

    /** Opens the dialog with the data of the server. */
    open(head: Head, file: string): void {
        this.spec = head.spec;
        this.stem = file.split(/[\\/]/).pop()!.replace(/\.[^.]*$/, "") || "harvester";
        find("export-link").textContent = `jounce explore --link '${head.link}'`;
        find("export-shell").textContent = head.shell;
        find("export-python").textContent = head.python;
        if (!this.dialog.open) this.dialog.showModal();
    }

    private picture(): void {
        const from = this.response.chart.canvas;
        if (!from) return;
        const sheet = document.createElement("canvas");
        [sheet.width, sheet.height] = [from.width, from.height];
        const ctx = sheet.getContext("2d")!;
        ctx.fillStyle = colour("paper");
        ctx.fillRect(0, 0, sheet.width, sheet.height);
        ctx.drawImage(from, 0, 0);
        sheet.toBlob((blob) => blob && save(`${this.stem}-response.png`, "image/png", blob));
    }
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
