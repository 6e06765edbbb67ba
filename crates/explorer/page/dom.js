// Elements, made in one line.

const SVG = "http://www.w3.org/2000/svg";

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== undefined && value !== false && value !== null) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== undefined && child !== null && child !== false));
  return element;
}

export const html = (name, attributes = {}, ...children) =>
  filled(document.createElement(name), attributes, children);
export const svg = (name, attributes = {}, ...children) =>
  filled(document.createElementNS(SVG, name), attributes, children);

const sizes = new Map();
const observer = new ResizeObserver((entries) => {
  for (const { target } of entries) sizes.set(target, [target.clientWidth, target.clientHeight]);
});

/** Width and height as they were last laid out; to ask for them anew lays out the page, if it has changed. */
export function sizeOf(element, anew = false) {
  if (anew || !sizes.has(element)) {
    if (!sizes.has(element)) observer.observe(element);
    sizes.set(element, [element.clientWidth, element.clientHeight]);
  }
  return sizes.get(element);
}

/**
 * Reports each move of a pointer over an element, where the browser does that, at once rather than with the next
 * frame, so that the answer is there when the frame is drawn.
 */
export function onMove(element, moved) {
  let last = [];
  for (const name of ["pointerrawupdate", "pointermove"]) {
    element.addEventListener(name, (event) => {
      const place = [event.pointerId, event.clientX, event.clientY];
      if (place.every((part, i) => part === last[i])) return;
      last = place;
      moved(event);
    });
  }
}

export const byId = (id) => document.getElementById(id);

/** A path through points of the screen. */
export function pathOf(points) {
  let text = "";
  for (let i = 0; i < points.length; i++)
    text += `${i ? "L" : "M"}${points[i][0].toFixed(2)} ${points[i][1].toFixed(2)}`;
  return text;
}
