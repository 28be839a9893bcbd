// SPDX-License-Identifier: MIT
// The kernel in the page: a module of WebAssembly, asked one pair at a time.

/** A file that make_page.py has compressed and written as base64. */
async function unpacked(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * The kernel's answers. Where the module ends itself, as on a broken contract or where memory ends, answer()
 * throws what the module said, and the next call starts it anew.
 */
class Kernel {
  static async load(base64) {
    const kernel = new Kernel();
    kernel.code = await WebAssembly.compile(await unpacked(base64));
    await kernel.start();
    return kernel;
  }

  async start() {
    this.said = "";
    const imports = {};
    for (const { module, name } of WebAssembly.Module.imports(this.code)) {
      imports[module] ??= {};
      imports[module][name] = () => 0;
    }
    // What the library writes goes to standard error, then the module ends.
    const system = (imports.wasi_snapshot_preview1 ??= {});
    system.fd_write = (_, vectors, count, written) => this.written(vectors, count, written);
    system.proc_exit = (status) => { throw new Error(this.said || `the kernel ended with ${status}`); };
    this.module = (await WebAssembly.instantiate(this.code, imports)).exports;
    this.module._initialize?.();
    const [ofPair, definitions, ofGap] = this.lists("answer_names");
    Object.assign(this, { ofPair, definitions, ofGap });
    [this.relations, this.inners, this.states] = this.lists("answer_words");
  }

  written(vectors, count, written) {
    const view = new DataView(this.module.memory.buffer);
    let total = 0;
    for (let i = 0; i < count; ++i) {
      const from = view.getUint32(vectors + 8 * i, true), length = view.getUint32(vectors + 8 * i + 4, true);
      this.said += new TextDecoder().decode(new Uint8Array(view.buffer, from, length));
      total += length;
    }
    view.setUint32(written, total, true);
    return 0;
  }

  text(from) {
    const bytes = new Uint8Array(this.module.memory.buffer, from);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  lists(name) { return this.text(this.module[name]()).split("\n").map((line) => line.split(",")); }

  /**
   * @param pair 20 numbers: the columns of a, then of b
   * @returns {refused} with the reason, or the numbers of the pair by name and {gaps}, by definition; null where
   *          there is no number
   */
  answer(pair) {
    const { module } = this;
    try {
      new Float64Array(module.memory.buffer, module.pair_numbers(), 20).set(pair);
      if (!module.answer_pair()) return { refused: this.text(module.refusal()) };
    } catch (error) {
      const said = new Error(this.said.trim() || error.message);
      this.restarted = this.start();
      throw said;
    }
    const numbers = new Float64Array(module.memory.buffer, module.answer_numbers());
    const shown = (x) => (Number.isNaN(x) ? null : x);
    let at = 0;
    const answer = Object.fromEntries(this.ofPair.map((name) => [name, shown(numbers[at++])]));
    answer.relation = this.relations[answer.relation];
    answer.inner = this.inners[answer.inner];
    answer.gaps = {};
    for (const definition of this.definitions) {
      const gap = Object.fromEntries(this.ofGap.map((name) => [name, shown(numbers[at++])]));
      gap.status = this.states[gap.status];
      answer.gaps[definition] = gap;
    }
    return answer;
  }
}
