// The compiled library: questions and answers as JSON, pictures and files as bytes, through the memory that both sides
// share.

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class Core {
  #wasm;

  /** Starts the library from its compiled module. */
  static async start(module) {
    const core = new Core();
    core.#wasm = (await WebAssembly.instantiate(module, {})).exports;
    return core;
  }

  /** The answer to a question; `error` says why there is none. */
  ask(question) {
    this.#write(encoder.encode(JSON.stringify(question)));
    return this.#read(this.#wasm.ask());
  }

  /** Opens the bytes of an atlas, and says what it is. */
  open(bytes) {
    this.#write(bytes);
    return this.#read(this.#wasm.open());
  }

  /** Works on some tiles of the slice, and says how many wait. */
  refine(tiles) {
    return this.#wasm.refine(tiles);
  }

  /** Whether every pixel of the slice is known; what waits then proves what lies between them. */
  drawn() {
    return this.#wasm.drawn() !== 0;
  }

  /** The flags of each pixel of the slice, column by column, from below: a copy. */
  pixels(count) {
    return new Uint8Array(this.#wasm.memory.buffer, this.#wasm.pixels(), count).slice();
  }

  /** How many pixels are proved with everything between their points. */
  proved() {
    return this.#wasm.proved();
  }

  #write(bytes) {
    const place = this.#wasm.room(bytes.length);
    // Only now: making room may have moved the memory.
    new Uint8Array(this.#wasm.memory.buffer, place, bytes.length).set(bytes);
  }

  #read(place) {
    return JSON.parse(decoder.decode(new Uint8Array(this.#wasm.memory.buffer, place, this.#wasm.length())));
  }
}
