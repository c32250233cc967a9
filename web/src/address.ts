// The fragment of the address: the design, its range, and what the page shows of it.

import type { Axes } from "./axes";
import type { Controls } from "./controls";
import { type Design, fromFragment, toFragment } from "./design";
import type { Head } from "./frame";
import type { Linked } from "./linked";
import type { Requests } from "./requests";

interface Views {
    axes: Axes;
    controls: Controls;
    design: Design;
    linked: Linked;
    requests: Requests;
}

/** Time without changes after which the address is updated. */
const RESTS_MS = 250;

export class Address {
    private begun = false;
    private resting = 0;

    constructor(private readonly views: Views) {
        addEventListener("pagehide", () => this.update());
        // A link that is pasted into the address of the open page.
        addEventListener("hashchange", (event) => this.pasted(new URL(event.newURL).hash));
    }

    /** Takes the first design of the page: that of its address, or else that of the server. */
    begin(head: Head): void {
        if (this.begun) return;
        const { axes, design, linked } = this.views;
        const { design: own, page } = fromFragment(location.hash);
        design.begin(own?.pairs ?? head.set);
        const view = own?.view ?? head.view;
        if (view) axes.set(view);
        linked.take(own || page.length > 0 ? page : head.page);
        this.begun = true;
    }

    /** Updates the address when the design rests: a browser is slow to set an address, and limits their rate. */
    change(): void {
        clearTimeout(this.resting);
        this.resting = setTimeout(() => this.update(), RESTS_MS);
    }

    private update(): void {
        clearTimeout(this.resting);
        const { axes, design, linked } = this.views;
        if (this.begun) history.replaceState(null, "", `#${toFragment(design.pairs, axes.view, linked.pairs)}`);
    }

    private pasted(fragment: string): void {
        const { axes, controls, design, linked, requests } = this.views;
        const { design: own, page } = fromFragment(fragment);
        if (!own && page.length === 0) return;
        if (own?.view) axes.set(own.view);
        // The design says whether it has the key of the axis.
        if (own?.view && !controls.find(own.view.over)) requests.forgetDesign();
        design.replace(own?.pairs ?? design.pairs);
        linked.take(page);
    }
}
