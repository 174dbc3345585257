// What `froxel load` tells: pure functions of what its viewers measured. The JSON:
//
//   schema            "froxel.load.v2"
//   froxel            this build's version
//   url, room, seconds, ramp_s, codec, video_kbps   as given
//   scripts           [{name, share}]; of a file the name alone
//   think             {least_s, most_s}, or null
//   stages            [{seconds, viewers}] as given, or null
//   viewers           that joined or tried to, in all
//   size              {width_px, height_px}, lights: as given; null: the server's own
//   served            [{viewers, server_version, device, scene, triangles, size, lights,
//                     lights_move, renderer, codec, quality, video_kbps}, ...]: what the server
//                     said as measuring began, each different answer once, with how many viewers
//                     got it; the scene by its name, size as asked for
//   host              threads (hardware threads of this machine, not of the server's)
//   measured_s        how long all viewers measured
//   stopped           whether a signal ended it early
//   ended_early       whether --stop-early did
//   requirements      [{requirement, measured, held}]; measured is null without a sample
//   broken            one line: which viewer failed, what was not held; null: all is well
//   all               of all viewers together: samples pooled, counts and rates added up
//   series            [...]: of each second, load_series.h
//   each              [...]: the same as of all, of every viewer, in the order in which they
//   joined, and
//     failure         one line, or null
//     refused         whether the failure is that the server had no place for it
//     first_frame_ms  from connecting to the first frame's last byte; null: there was none
//     first_frame_wait_ms   how long it waited for one that did not come; null: one came
//     stall_ms        95 % of the measured time no frame had been due for longer
//     (load/requirement.h)
//
// all and each[]:
//   frames, frames_per_s
//   latency_ms, reaction_ms, age_ms, interval_ms   load/viewer_meter.h says what they are
//                     latency_ms.count frames show a new command; the ages of the others in
//                     age_ms may be lower bounds. Commands that no frame showed are in reaction_ms
//                     with their wait so far
//   jitter_ms         interval_ms.p99 - interval_ms.median
//   stages_ms         {queue, render, encode_wait, encode, send_wait, network}: as in FrameHeader,
//                     of frames in the measured time; queue and network of those that show a new
//                     command
//   gpu_ms            the part of render on the device, of frames that tell it
//   timer_lag_ms      how late this process sent commands: where it is not small, the machine that
//                     runs the viewers was too slow to measure
//   received_bytes, sent_bytes, received_bytes_per_s   of the TCP connection, framing and pings too
//   frame_bytes       headers and pictures
//   depth_meshes, depth_bytes   of viewers that ask for depth; headers and meshes
//   smallest_picture, largest_picture   {width_px, height_px} of the frames, or null
//   server_dropped    frames that a newer one replaced before sending
//   client_dropped    frames that a newer one overtook before they were painted
//   commands, commands_skipped   skipped: cameras not sent, since others waited for the socket
//   commands_unshown  of both, those that no frame showed until the end
//   errors, errors_by_code, first_error   Error messages, {ErrorCode: count} of them, and the first
//                     one's text or null
//
// Each *_ms is {count, min, median, p95, p99, max, mean} in milliseconds, nearest ranks
// (report/statistics.h), or null without a sample.
#pragma once

#include "app/load_command.h"
#include "app/load_series.h"
#include "app/load_verdict.h"
#include "load/load_run.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace froxel::app {

// What was asked for: the members of the report from `froxel` to `host`.
[[nodiscard]] nlohmann::ordered_json loadSetup(const LoadOptions& options,
                                               const load::RunOptions& run);

// What was measured, each different one once, with the viewers that were served so.
[[nodiscard]] nlohmann::ordered_json servedKinds(const load::RunResult& result);
[[nodiscard]] nlohmann::ordered_json outcomesOf(const std::vector<load::Outcome>& outcomes);

[[nodiscard]] nlohmann::ordered_json loadReport(const LoadOptions& options,
                                                const load::RunOptions& run,
                                                const load::RunResult& result,
                                                const LoadVerdict& verdict,
                                                const std::vector<SeriesRow>& series);

// For a person: all viewers together, then one by one where they are few, then the requirements.
// Empty where none came to measure.
[[nodiscard]] std::string loadTable(const load::RunResult& result, const LoadVerdict& verdict);

// Of a second and the row that it makes: "12 s, 16 viewers, 0 joining, 0 failed, 512 frames/s, 81.2
// Mbit/s".
[[nodiscard]] std::string
loadProgress(const load::RunOptions& run, const load::RunSecond& second, const SeriesRow& row);

} // namespace froxel::app
