// What tests ask of a page in a browser; every answer is a list of faults in words, empty where there are none.
var examine = {
  texts() {
    const found = [], walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) {
      const node = walk.currentNode, owner = node.parentElement;
      if (!node.data.trim() || owner.closest("script, style, title, desc, option, .skip, details:not([open]) > :not(summary)")) continue;
      if (getComputedStyle(owner).visibility !== "visible") continue;
      const range = document.createRange();
      range.selectNodeContents(node);
      for (const box of range.getClientRects()) {
        if (box.width > 1 && box.height > 1) found.push({ owner, words: node.data.trim(), box });
      }
    }
    return found;
  },
  // Boxes of lines are taller than their letters; halos and descenders may touch.
  overlaps() {
    const texts = this.texts().map(({ owner, words, box }) => ({
      owner, words, left: box.left + 1, right: box.right - 1, top: box.top + 0.22 * box.height,
      bottom: box.bottom - 0.22 * box.height,
    })).sort((a, b) => a.top - b.top);
    const faults = [];
    texts.forEach((a, k) => {
      for (let next = k + 1; next < texts.length && texts[next].top < a.bottom; next++) {
        const b = texts[next];
        if (a.left < b.right && b.left < a.right) faults.push(`"${a.words.slice(0, 60)}" and "${b.words.slice(0, 60)}"`);
      }
    });
    return faults;
  },
  // Beyond its figure; beyond the page without a place that scrolls.
  cut() {
    const faults = [], wide = document.documentElement.clientWidth;
    for (const { owner, words, box } of this.texts()) {
      const figure = owner.closest("svg"), place = owner.closest(".wide, pre");
      const scrolls = place && getComputedStyle(place).overflowX === "auto";
      const edge = figure && figure.getBoundingClientRect();
      if (edge && (box.left < edge.left - 1 || box.right > edge.right + 1 || box.top < edge.top - 3
          || box.bottom > edge.bottom + 3)) faults.push(`"${words.slice(0, 60)}" leaves its figure`);
      if (!scrolls && (box.left < -1 || box.right > wide + 1)) faults.push(`"${words.slice(0, 60)}" leaves the page`);
    }
    if (document.documentElement.scrollWidth > wide + 1) faults.push("the page is wider than the window");
    return faults;
  },
  // WCAG 2.2, 1.4.3, and what is drawn, 1.4.11.
  contrast() {
    const number = (text) => text.match(/[\d.]+/g).map(Number);
    const part = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
    const light = ([r, g, b]) => 0.2126 * part(r / 255) + 0.7152 * part(g / 255) + 0.0722 * part(b / 255);
    const ground = (owner) => {
      for (let one = owner; one; one = one.parentElement) {
        const colour = number(getComputedStyle(one).backgroundColor);
        if (colour.length === 3 || colour[3] > 0) return colour;
      }
      return [255, 255, 255];
    };
    const faults = new Set();
    const compare = (owner, colour, least, words) => {
      const [a, b] = [light(number(colour)), light(ground(owner))].sort((one, other) => other - one);
      const ratio = (a + 0.05) / (b + 0.05);
      if (ratio < least) faults.add(`${words}: ${ratio.toFixed(2)}, ${least} wanted`);
    };
    for (const { owner, words } of this.texts()) {
      const style = getComputedStyle(owner);
      compare(owner, owner.closest("svg") ? style.fill : style.color, 4.5, words.slice(0, 60));
    }
    for (const shape of document.querySelectorAll(".chart .line, .chart .limit, .chart .hollow, .chart .axis")) {
      compare(shape, getComputedStyle(shape).stroke, 3, shape.getAttribute("class"));
    }
    return [...faults];
  },
  // Pixels that the font is high on the screen, whatever the font; in places that scroll it keeps its size.
  small(least) {
    const faults = new Set();
    for (const { owner, words } of this.texts()) {
      const drawn = owner.getScreenCTM ? owner.getScreenCTM() : null;
      const size = parseFloat(getComputedStyle(owner).fontSize) * (drawn ? Math.hypot(drawn.a, drawn.b) : 1);
      if (size < least) faults.add(`"${words.slice(0, 60)}": ${size.toFixed(2)}`);
    }
    return [...faults];
  },
};
