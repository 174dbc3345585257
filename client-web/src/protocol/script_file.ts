// A script for `froxel load --script`: JSON lines of the protocol's own messages with `at_ms`.
// Fetched when a recording is saved.

import { create, toJson } from '@bufbuild/protobuf';

import { ClientMessageSchema } from '../gen/froxel/v1/client_pb';
import type { Recorded } from './recorder';

/** A line for each command, with its line's end. */
export const scriptText = (commands: readonly Recorded[]): string =>
  commands
    .map(({ atMs, body }) => {
      const message = toJson(ClientMessageSchema, create(ClientMessageSchema, { body }));
      return `${JSON.stringify({ at_ms: atMs, ...(message as object) })}\n`;
    })
    .join('');
