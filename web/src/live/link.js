// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The connection to the run (include/vsa/view/request.hpp says what may be asked).

const kRetry_ms = 2000;

export class Link {
  /** on: { text(object), frame(buffer), open(), lost() } */
  constructor(on) {
    this.on = on;
    this.ended = false;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}/live`);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.addEventListener('open', () => {
      this.on.open();
    });
    socket.addEventListener('message', (e) => {
      if (typeof e.data === 'string') this.on.text(JSON.parse(e.data));
      else this.on.frame(e.data);
    });
    socket.addEventListener('close', () => {
      this.on.lost();
      setTimeout(() => this.connect(), kRetry_ms);
    });
  }

  get ready() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  ask(what, more = {}) {
    if (this.ready) this.socket.send(JSON.stringify({ do: what, ...more }));
  }
}
