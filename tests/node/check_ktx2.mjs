// Read NAME.ktx2 with ktx-parse and compare with NAME.samples.
// usage: check_ktx2.mjs FOLDER NAME...
import { strict as assert } from 'node:assert';
import { readFileSync } from 'node:fs';
import { read } from 'ktx-parse';

// channels, bits -> VkFormat
const formats = {
  '1,8': 9, '2,8': 16, '4,8': 37,
  '1,16': 70, '2,16': 77, '4,16': 91,
  '1,32': 100, '2,32': 103, '4,32': 109,
};

const channelIds = [0, 1, 2, 15];

function textOf(value) {
  return typeof value === 'string' ? value : new TextDecoder().decode(value).replace(/\0$/, '');
}

function check(folder, name) {
  const bytes = new Uint8Array(readFileSync(`${folder}/${name}.ktx2`));
  const samples = new Uint8Array(readFileSync(`${folder}/${name}.samples`));
  const container = read(bytes);
  const text = textOf(container.keyValue.heightcast);
  const info = Object.fromEntries(text.split(' ').map((word) => word.split('=')));
  const channels = Number(info.channels);
  const bits = Number(info.bits);
  const float = bits === 32;

  assert.equal(info.content, 'map');
  assert.equal(textOf(container.keyValue.KTXorientation), 'rd');
  assert.match(textOf(container.keyValue.KTXwriter), /^heightcast /);
  assert.equal(container.vkFormat, formats[`${channels},${bits}`]);
  assert.equal(container.typeSize, bits / 8);
  const { pixelWidth, pixelHeight, pixelDepth } = container;
  assert.deepEqual([pixelWidth, pixelHeight, pixelDepth], [37, 21, 0]);
  assert.equal(container.layerCount, 0);
  assert.equal(container.faceCount, 1);
  assert.equal(container.supercompressionScheme, 0);
  assert.equal(container.levels.length, Number(info.levels));

  const [descriptor] = container.dataFormatDescriptor;
  assert.equal(descriptor.colorModel, 1); // RGBSDA
  assert.equal(descriptor.transferFunction, 1); // linear
  assert.equal(descriptor.bytesPlane[0], (channels * bits) / 8);
  assert.equal(descriptor.samples.length, channels);
  descriptor.samples.forEach((sample, i) => {
    assert.equal(sample.bitOffset, i * bits);
    assert.equal(sample.bitLength, bits - 1);
    assert.equal(sample.channelType, channelIds[i] | (float ? 0xc0 : 0));
  });

  let at = 0;
  let previous = Infinity;
  container.levels.forEach((level, k) => {
    const texels = Math.max(1, 37 >> k) * Math.max(1, 21 >> k);
    const size = (texels * channels * bits) / 8;
    assert.equal(level.uncompressedByteLength, size);
    assert.deepEqual(Buffer.from(level.levelData), Buffer.from(samples.subarray(at, at + size)));
    at += size;
    // smallest first in the file, each at a multiple of the texel size and of 4
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    const offset = Number(view.getBigUint64(80 + 24 * k, true));
    assert.ok(offset < previous);
    assert.equal(offset % Math.max(4, (channels * bits) / 8), 0);
    previous = offset;
  });
  assert.equal(at, samples.length);
}

const [folder, ...names] = process.argv.slice(2);
for (const name of names) {
  try {
    check(folder, name);
  } catch (error) {
    console.error(`check_ktx2: ${name}.ktx2: ${error.message}`);
    process.exit(1);
  }
}
