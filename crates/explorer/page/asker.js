// Questions to a worker. Of each subject only the newest matters: a question waits while another of its subject is out,
// and one that waits gives way to a newer one.

/** Starts a worker with the compiled library. */
export class Asker {
  #worker;
  #out = new Map();
  #waiting = new Map();
  #next = 1;

  constructor(module, failed) {
    this.#worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    this.ready = new Promise((resolve) => this.#out.set(0, { resolve: () => resolve() }));
    this.#worker.onmessage = ({ data: { id, answer } }) => this.#told(id, answer);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      failed(event.message || "the worker does not start");
    };
    this.#worker.postMessage({ module });
  }

  /** An answer, however many other questions there are. */
  ask(question) {
    return new Promise((resolve) => this.#send({ question }, { resolve }));
  }

  /** The same of the bytes of a file, which go over to the worker. */
  open(bytes) {
    return new Promise((resolve) => this.#send({ bytes }, { resolve }, [bytes]));
  }

  /** The newest question of a subject; `told` gets its answer, unless a newer one takes its place before it is sent. */
  newest(subject, message, told) {
    const entry = { message, told };
    if ([...this.#out.values()].some((out) => out.subject === subject)) {
      this.#waiting.set(subject, entry);
      return;
    }
    this.#send(message, { subject, resolve: told });
  }

  /** A slice, each time that it is finer. An older one is given up. */
  slice(slice, told) {
    for (const [id, out] of this.#out) if (out.slice) this.#out.delete(id);
    this.#send({ slice }, { slice: true, resolve: told });
  }

  #send(message, out, transfer = []) {
    const id = this.#next++;
    this.#out.set(id, out);
    this.#worker.postMessage({ id, ...message }, transfer);
  }

  #told(id, answer) {
    const out = this.#out.get(id);
    if (!out) return;
    if (!out.slice || answer.done || answer.error) this.#out.delete(id);
    if (out.subject && this.#waiting.has(out.subject)) {
      const { message, told } = this.#waiting.get(out.subject);
      this.#waiting.delete(out.subject);
      this.#send(message, { subject: out.subject, resolve: told });
    }
    out.resolve(answer);
  }
}
