// Focus of an element that is hidden, disabled or removed: it moves to the nearest place before it, so that keys continue to work there.

const PLACES = "button, input, select, summary, a[href], [tabindex='0'], [role=tab]";

const canFocus = (element: HTMLElement) => element.isConnected && element.checkVisibility({ visibilityProperty: true, checkVisibilityCSS: true }) && !element.matches(":disabled, [tabindex='-1']");

/** Element with the focus, and the places around it when it got it: those before it, nearest first, then those after it. */
let places: HTMLElement[] = [];

addEventListener("focusin", ({ target }) => {
    const all = [...document.querySelectorAll<HTMLElement>(PLACES)];
    const index = all.indexOf(target as HTMLElement);
    places = index < 0 ? [] : [...all.slice(0, index + 1).reverse(), ...all.slice(index + 1)];
});
// An element that is removed loses the focus first; one that remains has lost it to the page.
addEventListener("focusout", () => setTimeout(() => {
    if (document.activeElement === document.body && places[0] && canFocus(places[0])) places = [];
}));

/** Watches for changes that take the focus away. */
export function keepFocus(): void {
    const restore = () => {
        const own = document.activeElement;
        if (places.length === 0 || canFocus(places[0]) || (own !== places[0] && own !== document.body)) return;
        const next = places.find(canFocus);
        places = [];
        next?.focus();
    };
    new MutationObserver(restore).observe(document.body, { subtree: true, childList: true, attributeFilter: ["hidden", "disabled", "class"] });
}
