// Requests that tell how much of a body has gone, which fetch does not.

import type { Transport } from './sender';

export class XhrTransport implements Transport {
  /** Empty: none is needed. */
  constructor(private readonly token: () => string) {}

  ask(
    method: string,
    path: string,
    fields: Readonly<Record<string, string>>,
    body: Blob | string | null,
    signal: AbortSignal,
    told?: (bytes: number) => void,
  ): ReturnType<Transport['ask']> {
    return new Promise((done, failed) => {
      const request = new XMLHttpRequest();
      const end = (): void => request.abort();
      request.open(method, new URL(path, document.baseURI));
      const token = this.token();
      if (token !== '') request.setRequestHeader('Authorization', `Bearer ${token}`);
      for (const [name, value] of Object.entries(fields)) request.setRequestHeader(name, value);
      if (told) request.upload.addEventListener('progress', ({ loaded }) => told(loaded));
      request.addEventListener('loadend', () => {
        signal.removeEventListener('abort', end);
        if (signal.aborted) failed(signal.reason as Error);
        else if (request.status === 0) failed(new Error('The server does not answer.'));
        else {
          const { status, responseText: text } = request;
          done({ status, text, field: (name) => request.getResponseHeader(name) });
        }
      });
      signal.addEventListener('abort', end);
      request.send(body);
    });
  }

  wait(ms: number, signal: AbortSignal): Promise<void> {
    return new Promise((done, failed) => {
      const timer = setTimeout(done, ms);
      signal.addEventListener('abort', () => {
        clearTimeout(timer);
        failed(signal.reason as Error);
      });
    });
  }
}
