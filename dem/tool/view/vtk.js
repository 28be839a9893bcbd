// SPDX-License-Identifier: MIT
// Files .vtp as dem/tool/vtk_file writes them: XML, then the arrays as raw bytes in blocks compressed by zlib.

const HERE_IS_LITTLE_ENDIAN = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1;
const NUMBERS = { Float64: Float64Array, Float32: Float32Array, Int32: Int32Array };

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** One file. An array is unpacked when it is first asked for. */
class VtkFile {
  /** @param base64 of the whole file */
  constructor(base64) {
    const text = atob(base64.trim());
    const end = text.indexOf("<AppendedData");
    this.first = text.indexOf("_", end) + 1;
    if (end < 0 || this.first === 0) throw new Error("a frame is no .vtp file");
    this.bytes = Uint8Array.from(text, (character) => character.charCodeAt(0));
    const xml = new DOMParser().parseFromString(text.slice(0, end) + "</VTKFile>", "text/xml");
    this.isLittleEndian = xml.documentElement.getAttribute("byte_order") !== "BigEndian";
    this.arrays = [...xml.querySelectorAll("DataArray")].map((element) => ({
      of: element.parentElement.tagName,
      name: element.getAttribute("Name"),
      type: element.getAttribute("type"),
      components: Number(element.getAttribute("NumberOfComponents")),
      offset: Number(element.getAttribute("offset")),
    }));
    this.unpacked = new Map();
  }

  /** Arrays of "PointData", "CellData" or "FieldData". */
  of(section) { return this.arrays.filter((array) => array.of === section); }

  /** The numbers of an array; null where the file has none of that name. */
  async numbers(section, name) {
    const array = this.arrays.find((one) => one.of === section && one.name === name);
    if (!array) return null;
    if (!this.unpacked.has(array)) this.unpacked.set(array, this.unpack(array));
    return this.unpacked.get(array);
  }

  async unpack({ type, offset }) {
    const start = this.first + offset, header = new DataView(this.bytes.buffer);
    const count = (k) => Number(header.getBigUint64(start + 8 * k, this.isLittleEndian));
    const blocks = [];
    let at = start + 8 * (3 + count(0));
    for (let k = 0; k < count(0); ++k) {
      blocks.push(await inflated(this.bytes.subarray(at, at + count(3 + k))));
      at += count(3 + k);
    }
    const whole = new Uint8Array(blocks.reduce((sum, block) => sum + block.length, 0));
    blocks.reduce((place, block) => (whole.set(block, place), place + block.length), 0);
    const size = NUMBERS[type].BYTES_PER_ELEMENT;
    if (this.isLittleEndian !== HERE_IS_LITTLE_ENDIAN)
      for (let k = 0; k < whole.length; k += size) whole.subarray(k, k + size).reverse();
    return new NUMBERS[type](whole.buffer);
  }
}
