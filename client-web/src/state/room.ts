// Who is in the room, as the server tells it, and what that lets this viewer do.

import type { RoomState } from '../gen/froxel/v1/server_pb';

export interface Member {
  readonly id: bigint;
  readonly name: string;
  readonly asking: boolean;
  readonly away: boolean;
}

export interface Room {
  readonly name: string;
  readonly you: bigint;
  readonly controller: bigint; // 0: free
  readonly memberCount: number;
  readonly members: readonly Member[]; // not all of a large room
}

export function roomOf(told: RoomState): Room {
  return {
    name: told.room,
    you: told.you,
    controller: told.controller,
    memberCount: told.memberCount,
    members: told.members.map(({ id, name, asking, away }) => ({ id, name, asking, away })),
  };
}

/** Whether this viewer's commands set the view; without a room they always do. */
export const mayControl = (room: Room | null): boolean =>
  room === null || room.controller === room.you;

export const isAsking = (room: Room): boolean =>
  room.members.some(({ id, asking }) => id === room.you && asking);

/** One line for everyone: who controls, and how many watch. */
export function roomText(room: Room): string {
  const watching = room.memberCount - (room.controller === 0n ? 0 : 1);
  const others = `${watching} ${watching === 1 ? 'watches' : 'watch'}`;
  if (room.controller === 0n) return `Nobody controls room ${room.name}; ${others}.`;
  const who = room.controller === room.you ? 'You control' : `Viewer ${room.controller} controls`;
  return `${who} room ${room.name}; ${others}.`;
}

const kRoomName = /^[A-Za-z0-9._-]{1,64}$/;

export type WantedRoom =
  | { readonly name: string } // empty: a session of one's own
  | { readonly problem: string };

/** From the page's address, "?room=NAME". */
export function roomFromAddress(search: string): WantedRoom {
  const name = new URLSearchParams(search).get('room') ?? '';
  if (name === '' || kRoomName.test(name)) return { name };
  return {
    problem: `room=${name.slice(0, 80)} is not a room name: use 1 to 64 characters of A-Z a-z 0-9 . _ -.`,
  };
}
