// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A viewer of the live page's socket without a browser, for the measuring programs beside it.
import { connect } from 'node:net';

/** A short text as a masked frame (RFC 6455), mask 0. */
const masked = (text) => Buffer.concat([Buffer.from([0x81, 0x80 | text.length, 0, 0, 0, 0]), Buffer.from(text)]);
const next = masked('{"do":"next"}');

/** Takes frames as fast as it gets them and gives each one's bytes to onFrame. */
export function view(port, onFrame) {
  const socket = connect(port, '127.0.0.1', () =>
    socket.write(
      `GET /live HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n` +
        'Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n',
    ),
  );
  let kept = Buffer.alloc(0);
  let upgraded = false;
  socket.on('data', (piece) => {
    kept = Buffer.concat([kept, piece]);
    if (!upgraded) {
      const end = kept.indexOf('\r\n\r\n');
      if (end < 0) return;
      upgraded = true;
      kept = kept.subarray(end + 4);
    }
    for (;;) {
      if (kept.length < 4) return;
      const short = kept[1] & 0x7f;
      const [head, size] = short < 126 ? [2, short] : short === 126 ? [4, kept.readUInt16BE(2)] : [10, kept.length < 10 ? Infinity : Number(kept.readBigUInt64BE(2))];
      if (kept.length < head + size) return;
      if ((kept[0] & 0x0f) === 2) {
        onFrame(kept.subarray(head, head + size));
        socket.write(next);
      }
      kept = kept.subarray(head + size);
    }
  });
  socket.on('error', () => {});
  return { say: (text) => socket.write(masked(text)), close: () => socket.destroy() };
}
