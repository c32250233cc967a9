// What a link shows of a design: the open tab, the quantity, the toggles, the magnified part, the selected orbit and the plane of the basins.

import type { Basins } from "./basins";
import type { Fault } from "./frame";
import type { Quantities } from "./quantities";
import type { Response } from "./response";
import type { Selection } from "./selection";
import type { Tabs } from "./tabs";

/** A field of a link; without it, it has its default, which is written as "". */
interface Field {
    name: string;
    read: () => string;
    /** Shows a value; returns a message where it cannot. */
    show: (value: string) => string | undefined | Promise<string | undefined>;
    /** What must be known before the value can be shown. */
    needs: "design" | "response";
}

interface Views {
    basins: Basins;
    quantities: Quantities;
    response: Response;
    selection: Selection;
    tabs: Tabs;
}

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Name of a tab in a link; the others have that of their element. */
const EXCITATION: [string, string] = ["excitation", "tab-shake"];

export class Linked {
    private readonly fields: Field[];
    /** Values of a link that are not shown yet. */
    private readonly pending = new Map<string, string>();

    /** `tell` shows the messages about values that cannot be shown. */
    constructor(views: Views, private readonly tell: (stage: Field["needs"], faults: Fault[]) => void) {
        this.fields = [...controlFields(views), ...responseFields(views)];
    }

    /** The fields that have no default. */
    get pairs(): [string, string][] {
        return this.fields.map(({ name, read }): [string, string] => [name, this.pending.get(name) ?? read()]).filter(([, value]) => value !== "");
    }

    /** Takes the fields of a link; those that it lacks get their defaults. A link of a design alone has none: the page then shows the same of the new design. */
    take(pairs: [string, string][]): void {
        if (pairs.length === 0) return;
        const values = new Map(pairs);
        for (const { name } of this.fields) this.pending.set(name, values.get(name) ?? "");
    }

    /** Shows the fields for which enough is known. */
    reached(stage: Field["needs"]): void {
        const due = this.fields.filter(({ name, needs }) => needs === stage && this.pending.has(name));
        const shown = due.map(({ name, show }) => {
            const value = this.pending.get(name)!;
            this.pending.delete(name);
            return show(value);
        });
        void Promise.all(shown).then((found) => {
            const messages = found.filter((message) => message !== undefined);
            if (messages.length > 0) this.tell(stage, messages.map((message) => ({ key: "", line: 0, message })));
        });
    }

    /** Gives a field up that the user has set meanwhile. */
    drop(name: string): void {
        this.pending.delete(name);
    }
}

/** Fields that the controls of the tabs hold. */
function controlFields({ basins, quantities, response, tabs }: Views): Field[] {
    const toggle = (name: string, id: string, usual: boolean): Field => ({
        name, needs: "design",
        read: () => (find<HTMLInputElement>(id).checked === usual ? "" : usual ? "no" : "yes"),
        show: (value) => {
            if (!["", "yes", "no"].includes(value)) return `the link has ${name} = "${value}"; it is yes or no`;
            const box = find<HTMLInputElement>(id);
            const checked = value === "" ? usual : value === "yes";
            if (box.checked !== checked) box.click();
            return undefined;
        },
    });
    const ends = (name: "displacement" | "velocity"): Field => ({
        name, needs: "design", read: () => basins.plane.ends(name), show: (value) => basins.plane.setEnds(name, value),
    });
    return [
        { name: "show", needs: "design", read: () => (response.quantity === "power" ? "" : response.quantity), show: (value) => quantities.choose(value || "power") },
        toggle("log", "log", true),
        toggle("grazings", "grazings", false),
        toggle("long_periods", "long-periods", false),
        { name: "starts", needs: "design", read: () => basins.plane.starts, show: (value) => basins.plane.setStarts(value) },
        ends("displacement"),
        ends("velocity"),
        {
            name: "tab", needs: "design",
            // Always in a link: it differs from a link of a design alone.
            read: () => (tabs.shownId === EXCITATION[1] ? EXCITATION[0] : tabs.shownId.replace("tab-", "")),
            show: (value) => (tabs.show(value === EXCITATION[0] ? EXCITATION[1] : `tab-${value || "response"}`) ? undefined : `the link opens the tab "${value}", which this page does not have`),
        },
    ];
}

/** Fields on the chart of the response. */
function responseFields({ response, selection }: Views): Field[] {
    const { chart } = response;
    return [
        {
            name: "zoom", needs: "response",
            read: () => chart.visiblePart?.flat().map((end) => Number(end.toPrecision(6))).join(":") ?? "",
            show: (value) => {
                if (value === "" && chart.isZoomed) chart.unzoom();
                if (value === "") return undefined;
                return chart.showPart(value.split(":").map(Number)) ? undefined : `the link magnifies "${value}", which is no part of this chart`;
            },
        },
        {
            name: "orbit", needs: "response",
            read: () => selection.text,
            show: (value) => (value === "" ? undefined : selection.open(value)),
        },
    ];
}
