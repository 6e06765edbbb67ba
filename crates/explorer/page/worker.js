// A worker: the library beside the page, so that the page never waits.
//
// It gets { id, question }, { id, bytes } or { id, slice }, and answers { id, answer }. A slice comes in several
// messages, each finer. A newer slice takes the place of the one in the making.

import { Core } from "./core.js";

/** Milliseconds of work on a slice before the worker listens again. */
const PACE = 12;
/** Tiles between two looks at the clock. */
const TILES = 4;

let core;
let making;

const started = new Promise((resolve) => {
  self.onmessage = async ({ data }) => {
    core = await Core.start(data.module);
    resolve();
  };
}).then(() => {
  self.onmessage = ({ data }) => answer(data);
});

started.then(() => self.postMessage({ id: 0, answer: {} }));

// Wakes up after the messages that wait, without the delay of a timer.
const channel = new MessageChannel();
channel.port1.onmessage = () => refine();

function answer({ id, question, bytes, slice }) {
  if (slice) {
    const about = core.ask({ ask: "slice", ...slice });
    making = about.error
      ? undefined
      : { id, about, width: slice.width, height: slice.height, began: performance.now(), next: PACE };
    if (about.error) self.postMessage({ id, answer: about });
    else refine();
    return;
  }
  self.postMessage({ id, answer: bytes ? core.open(new Uint8Array(bytes)) : core.ask(question) });
}

function refine() {
  if (!making) return;
  const { id, about, width, height, began } = making;
  const until = performance.now() + PACE;
  let left = 1;
  while (left > 0 && performance.now() < until) left = core.refine(TILES);
  const whole = core.drawn() && !making.took;
  if (whole) making.took = performance.now() - began;
  // Each picture comes after twice the time of the one before, because the page paints it.
  if (left === 0 || whole || performance.now() - began >= making.next) {
    making.next = 2 * (performance.now() - began);
    const pixels = core.pixels(width * height);
    const reached = { drawn: core.drawn(), done: left === 0, proved: core.proved(), took: making.took };
    const answer = { ...about, width, height, pixels, ...reached };
    self.postMessage({ id, answer }, [pixels.buffer]);
  }
  if (left > 0) channel.port2.postMessage(0);
  else making = undefined;
}
