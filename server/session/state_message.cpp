#include "session/state_message.h"

#include "core/assert.h"
#include "froxel/v1/server.pb.h"
#include "protocol/limits.h"
#include "scene/motion.h"
#include "session/placed_lights.h"
#include "session/proto_enums.h"
#include "session/proto_vec.h"
#include "session/view_state.h"
#include "settings/ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace froxel::session {
namespace {

void fill(v1::CameraPose& out, const settings::Camera& camera) {
    fillVec(*out.mutable_eye(), camera.eye_world);
    fillVec(*out.mutable_target(), camera.target_world());
    fillVec(*out.mutable_up(), camera.world_from_view[1]);
}

void fill(v1::SceneInfo& out, const SessionContext& context) {
    const SceneSummary& scene = context.scene;
    out.set_id(context.scene_id);
    out.set_name(scene.name);
    out.set_triangles(scene.triangle_count);
    out.set_draws(scene.draw_count);
    out.set_materials(scene.material_count);
    out.set_textures(scene.texture_count);
    out.set_punctual_lights(scene.punctual_light_count);
    out.set_detail_levels(scene.detail_levels);
    for (const scene::NamedCamera& camera : scene.cameras) {
        out.add_cameras(camera.name);
        v1::SceneCamera& view = *out.add_camera_views();
        fill(*view.mutable_pose(), camera.camera);
        if (camera.camera.projection == settings::Projection::kPerspective) {
            view.set_fov_deg(glm::degrees(camera.camera.yfov_rad));
        }
    }
    if (!scene.bounds_world.empty()) {
        fillBox(*out.mutable_bounds(), scene.bounds_world);
    }
    for (const std::string& name : scene.material_variants) {
        out.add_material_variants(name);
    }
    if (scene.motion) {
        for (const scene::Clip& clip : scene.motion->clips) {
            v1::SceneAnimation& row = *out.add_animations();
            row.set_name(clip.name);
            row.set_duration_s(clip.duration_s);
        }
    }
    const size_t told = std::min(scene.warnings.size(), protocol::kMaxSceneWarningsTold);
    for (size_t i = 0; i < told; ++i) {
        const scene::Warning& warning = scene.warnings[i];
        v1::SceneWarning& row = *out.add_warnings();
        row.set_code(warning.code);
        row.set_severity(static_cast<v1::Severity>(warning.severity));
        row.set_pointer(warning.pointer);
        row.set_message(warning.message);
    }
    out.set_warnings_left_out(scene.warnings.size() - told + scene.warnings_left_out);
}

void fill(v1::RoomState& out, const Room& room, MemberId you) {
    out.set_room(room.name());
    out.set_you(you);
    out.set_controller(room.controller());
    out.set_member_count(static_cast<uint32_t>(room.members().size()));
    const auto asks = [&room](MemberId id) {
        return std::find(room.asking().begin(), room.asking().end(), id) != room.asking().end();
    };
    const auto tell = [&](const Room::Member* member) {
        if (member == nullptr ||
            static_cast<size_t>(out.members_size()) >= protocol::kMaxRoomMembersTold) {
            return;
        }
        v1::RoomMember& row = *out.add_members();
        row.set_id(member->id);
        row.set_name(member->name);
        row.set_asking(asks(member->id));
        row.set_away(member->away);
    };
    tell(room.find(room.controller()));
    for (const MemberId id : room.asking()) {
        tell(room.find(id));
    }
    for (const Room::Member& member : room.members()) {
        if (member.id != room.controller() && !asks(member.id)) {
            tell(&member);
        }
    }
}

void addRange(v1::Welcome& welcome, std::string_view field, double min, double max) {
    v1::FieldRange& out = *welcome.add_ranges();
    out.set_field(std::string(field));
    out.set_min(min);
    out.set_max(max);
}

// Every range that a client can run into.
void addRanges(v1::Welcome& welcome) {
    for (const SessionSetting& setting : sessionSettings()) {
        const settings::Setting& facts = setting.facts();
        if (facts.min < facts.max) {
            addRange(welcome, facts.name, facts.min, facts.max);
        }
    }
    const auto add = [&welcome](const auto& range) {
        addRange(welcome, range.field, static_cast<double>(range.min),
                 static_cast<double>(range.max));
    };
    std::apply([&](const auto&... range) { (add(range), ...); }, settings::kOtherRanges);
}

v1::ErrorCode protoCode(RejectCode code) {
    switch (code) {
    case RejectCode::kMalformed:
        return v1::ERROR_CODE_MALFORMED;
    case RejectCode::kOutOfRange:
        return v1::ERROR_CODE_OUT_OF_RANGE;
    case RejectCode::kUnsupported:
        return v1::ERROR_CODE_UNSUPPORTED;
    case RejectCode::kVersion:
        return v1::ERROR_CODE_VERSION;
    case RejectCode::kCapacity:
        return v1::ERROR_CODE_CAPACITY;
    case RejectCode::kRateLimit:
        return v1::ERROR_CODE_RATE_LIMIT;
    case RejectCode::kDevice:
        return v1::ERROR_CODE_DEVICE;
    case RejectCode::kControl:
        return v1::ERROR_CODE_CONTROL;
    case RejectCode::kToken:
        return v1::ERROR_CODE_TOKEN;
    }
    return v1::ERROR_CODE_UNSPECIFIED;
}

void fill(v1::DebugLegend& out, const DebugLegend& legend) {
    const auto named =
        std::find(settings::kDebugViewNames.begin(), settings::kDebugViewNames.end(), legend.view) -
        settings::kDebugViewNames.begin();
    out.set_view(toProto<v1::DebugView>(settings::kDebugViewNames, named));
    out.set_words(legend.words);
    out.set_min(legend.min);
    out.set_max(legend.max);
    out.set_unit(legend.unit);
    out.mutable_colors()->Add(legend.colors.begin(), legend.colors.end());
}

void fillLists(v1::FrameHeader& out, const LightListStats& lists) {
    out.set_light_count(lists.light_count);
    out.set_list_entries(lists.entry_count);
    out.set_list_mean(lists.mean);
    out.set_list_p95(lists.p95);
    out.set_list_largest(lists.largest);
    out.set_list_clusters(lists.cluster_count);
    out.set_list_empty(lists.empty_count);
    out.set_list_bytes(lists.bytes);
    out.set_lists_overflowed(lists.overflowed);
    out.set_list_redraws(lists.redraw_count);
    out.set_lists_capped(lists.capped_count);
    out.set_list_dropped(lists.dropped_count);
    out.set_list_dropped_irradiance(lists.dropped_irradiance);
    out.set_all_lights(lists.all_lights);
    out.set_list_why(lists.why);
}

void fill(v1::FrameGrid& out, const GridStats& grid) {
    out.set_x(grid.x);
    out.set_y(grid.y);
    out.set_z(grid.z);
    out.set_tile_width_px(grid.tile_width_px);
    out.set_tile_height_px(grid.tile_height_px);
    out.set_near_m(grid.near_m);
    out.set_far_m(grid.far_m);
    out.set_automatic(grid.automatic);
    out.set_why(grid.why);
}

void fill(v1::PictureCamera& out, const settings::Camera& camera) {
    fillVec(*out.mutable_eye(), camera.eye_world);
    fillVec(*out.mutable_right(), camera.world_from_view[0]);
    fillVec(*out.mutable_up(), camera.world_from_view[1]);
    out.set_half_height(std::tan(camera.yfov_rad / 2));
    out.set_lens_shift_x(camera.lens_shift.x);
    out.set_lens_shift_y(camera.lens_shift.y);
}

// Durations and counts on the wire stop at the largest u32: 71 minutes, where exactness is moot.
template <class T>
uint32_t saturated(T value) {
    constexpr auto kMax = std::numeric_limits<uint32_t>::max();
    if constexpr (std::is_floating_point_v<T>) {
        return value > 0 ? static_cast<uint32_t>(std::min(std::round(value), double{kMax})) : 0;
    } else {
        return static_cast<uint32_t>(std::min<T>(value, kMax));
    }
}

void fillDelivery(v1::FrameHeader& out, const FrameRecord& record) {
    const Delivered& delivered = record.delivered;
    out.set_scale(delivered.scale);
    out.set_geometry_error_px(delivered.geometry_error_px);
    const settings::CodecRow& codec = settings::rowOf(delivered.encoding.codec);
    out.set_quality(
        codec.rate_control == settings::RateControl::kQuality ? delivered.encoding.quality : 0);
    out.set_chroma(toProto<v1::Chroma>(settings::kChromaNames, delivered.encoding.chroma));
    out.set_refinement(toProto<v1::Refinement>(kRefinementNames, delivered.refinement));
    out.set_rung(delivered.rung);
    out.set_queue_delay_us(saturated(record.queue_delay_us));
    // A link that nothing was measured of yet, or so fast that a double of its bits means nothing.
    constexpr double kMost = 1e15;
    out.set_link_bits_per_s(static_cast<uint64_t>(std::clamp(record.link_bits_per_s, 0.0, kMost)));
}

void fill(v1::Part& part, const FrameRecord& record) {
    part.set_length(saturated(record.encoded_bytes));
    part.set_width(record.width_px);
    part.set_height(record.encodedHeight());
    const settings::Codec codec = record.delivered.encoding.codec;
    part.set_codec(toProto<v1::Codec>(settings::kCodecNames, codec));
    part.set_key_frame(settings::rowOf(codec).frames_depend && record.key);
}

void fillPasses(google::protobuf::RepeatedPtrField<v1::PassTime>& out, const FrameStats& stats) {
    for (const PassTime& pass : stats.passes) {
        v1::PassTime& row = *out.Add();
        row.set_name(pass.name);
        if (pass.gpu_us) {
            row.set_gpu_us(saturated(*pass.gpu_us));
        }
    }
}

void fill(v1::Compared& out, const ComparedRecord& compared) {
    out.set_layered(compared.layered);
    out.set_promised(compared.promised);
    out.set_differing(compared.differing_count);
    out.set_max(compared.max_abs);
    out.set_rmse(compared.rmse);
    if (compared.flip) {
        out.set_flip(*compared.flip);
    }
    if (const auto& first = compared.first) {
        v1::PixelPair& pixel = *out.mutable_first();
        pixel.set_x(first->x);
        pixel.set_y(first->y);
        pixel.set_left(first->left_rgb);
        pixel.set_right(first->right_rgb);
    }
    out.set_left_us(saturated(compared.left_us));
    out.set_right_us(saturated(compared.right_us));
    if (compared.right_stats.gpu_us) {
        out.set_right_gpu_us(saturated(*compared.right_stats.gpu_us));
    }
    fillPasses(*out.mutable_right_passes(), compared.right_stats);
}

void fillLooks(google::protobuf::RepeatedPtrField<v1::Look>& out, const SessionContext& context) {
    for (const OfferedLook& look : context.looks) {
        v1::Look& offered = *out.Add();
        offered.set_name(look.name);
        offered.set_label(look.label);
        offered.set_help(look.help);
        offered.set_address(look.address);
    }
}

// The row names the header's field. Counts that do not fit are the largest there is.
void fill(v1::FrameHeader& header, const Stat& stat) {
    using Field = google::protobuf::FieldDescriptor;
    google::protobuf::Message* to = &header;
    const auto field = [&to](std::string_view name) {
        const Field* found = to->GetDescriptor()->FindFieldByName(std::string(name));
        FROXEL_ASSERT(found != nullptr, "a StatRow names fields of the schema");
        return found;
    };
    if (!stat.row->group.empty()) {
        to = to->GetReflection()->MutableMessage(to, field(stat.row->group));
    }
    const Field* in = field(stat.row->field);
    const auto* reflection = to->GetReflection();
    switch (in->cpp_type()) {
    case Field::CPPTYPE_UINT32:
        reflection->SetUInt32(to, in, saturated(static_cast<int64_t>(stat.value)));
        break;
    case Field::CPPTYPE_UINT64:
        reflection->SetUInt64(to, in, static_cast<uint64_t>(stat.value));
        break;
    default:
        reflection->SetDouble(to, in, stat.value);
        break;
    }
}

} // namespace

v1::ServerMessage
makeWelcome(uint64_t session_id, const SessionContext& context, const SessionState& state) {
    v1::ServerMessage message;
    v1::Welcome& welcome = *message.mutable_welcome();
    welcome.set_protocol_major(protocol::kMajor);
    welcome.set_protocol_minor(protocol::kMinor);
    welcome.set_session_id(session_id);
    welcome.set_server_version(context.server_version);
    welcome.set_device(context.device_name);
    fill(*welcome.mutable_scene(), context);
    fillViewState(*welcome.mutable_state(), context, state);
    *welcome.mutable_placed_lights() = changeOf({}, state.settings.lights.placed);
    addRanges(welcome);
    fillLooks(*welcome.mutable_looks(), context);
    return message;
}

void addPlace(v1::ServerMessage& message,
              const SessionContext& context,
              const WelcomePlace& place) {
    v1::Welcome& welcome = *message.mutable_welcome();
    if (!place.resume_token.empty()) {
        welcome.set_resume_token(place.resume_token);
        welcome.set_resume_grace_ms(saturated(place.resume_grace.count()));
    }
    welcome.set_resumed(place.resumed);
    welcome.set_offers_depth(place.offers_depth);
    if (place.room != nullptr) {
        fill(*welcome.mutable_room(), *place.room, place.member);
    }
    if (place.defaults != nullptr) {
        fillViewState(*welcome.mutable_defaults(), context, *place.defaults);
        *welcome.mutable_default_placed_lights() =
            changeOf({}, place.defaults->settings.lights.placed);
    }
}

v1::ServerMessage makeRoomState(const Room& room, MemberId you) {
    v1::ServerMessage message;
    fill(*message.mutable_room_state(), room, you);
    return message;
}

v1::ServerMessage makeStateChanged(const SessionContext& context,
                                   const SessionState& state,
                                   const settings::PlacedLights& told) {
    v1::ServerMessage message;
    message.mutable_state()->set_ref_seq(state.applied.seq);
    fillViewState(*message.mutable_state()->mutable_state(), context, state);
    if (const settings::PlacedLights& placed = state.settings.lights.placed; !(placed == told)) {
        *message.mutable_state()->mutable_placed_lights() = changeOf(told, placed);
    }
    return message;
}

v1::ServerMessage
makeSceneChanged(const SessionState& state, const SessionState& first, uint64_t ref_seq) {
    v1::ServerMessage message;
    v1::SceneChanged& changed = *message.mutable_scene_changed();
    const SessionContext& context = *state.scene;
    changed.set_ref_seq(ref_seq);
    fill(*changed.mutable_scene(), context);
    fillViewState(*changed.mutable_state(), context, state);
    fillViewState(*changed.mutable_defaults(), context, first);
    fillLooks(*changed.mutable_looks(), context);
    *changed.mutable_placed_lights() = changeOf({}, state.settings.lights.placed);
    *changed.mutable_default_placed_lights() = changeOf({}, first.settings.lights.placed);
    return message;
}

v1::ServerMessage makeLoading(const Progress& progress) {
    v1::ServerMessage message;
    message.mutable_loading()->set_stage(progress.stage);
    message.mutable_loading()->set_fraction(progress.fraction);
    return message;
}

v1::ServerMessage makeSceneLoading(const std::string& id, const Progress& progress) {
    v1::ServerMessage message;
    v1::SceneLoading& loading = *message.mutable_scene_loading();
    loading.set_scene(id);
    loading.set_stage(progress.stage);
    loading.set_fraction(progress.fraction);
    return message;
}

std::string nameOf(RejectCode code) {
    std::string name = v1::ErrorCode_Name(protoCode(code)).substr(sizeof "ERROR_CODE_" - 1);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char letter) { return static_cast<char>(std::tolower(letter)); });
    return name;
}

v1::ServerMessage makeError(const Rejection& rejection) {
    v1::ServerMessage message;
    v1::Error& error = *message.mutable_error();
    error.set_code(protoCode(rejection.code));
    error.set_ref_seq(rejection.ref_seq);
    error.set_field(rejection.field);
    error.set_message(rejection.message);
    return message;
}

v1::ServerMessage makePong(const CommandStamp& ping) {
    v1::ServerMessage message;
    message.mutable_pong()->set_ref_seq(ping.seq);
    message.mutable_pong()->set_client_time_us(ping.client_time_us);
    return message;
}

v1::ServerMessage makeDraining(std::chrono::milliseconds deadline,
                               const std::string& reconnect_url) {
    v1::ServerMessage message;
    message.mutable_draining()->set_deadline_ms(saturated(deadline.count()));
    message.mutable_draining()->set_reconnect_url(reconnect_url);
    return message;
}

v1::ServerMessage makeFrameDetails(const FrameDetails& details) {
    v1::ServerMessage message;
    v1::FrameDetails& out = *message.mutable_details();
    for (const std::string& line : details.plan) {
        out.add_plan(line);
    }
    for (const MemoryUse& use : details.memory) {
        v1::MemoryUse& row = *out.add_memory();
        row.set_purpose(use.purpose);
        row.set_bytes(use.bytes);
    }
    if (details.legend) {
        fill(*out.mutable_legend(), *details.legend);
    }
    return message;
}

v1::FrameHeader makeFrameHeader(const FrameRecord& record) {
    v1::FrameHeader header;
    header.set_frame_id(record.frame_id);
    header.set_applied_seq(record.applied.seq);
    header.set_applied_client_time_us(record.applied.client_time_us);
    header.set_width(record.width_px);
    header.set_height(record.height_px);
    fill(*header.add_parts(), record);
    header.set_queue_us(saturated(record.queue_us));
    header.set_render_us(saturated(record.render_us));
    if (record.stats.gpu_us) {
        header.set_gpu_us(saturated(*record.stats.gpu_us));
    }
    header.set_encode_wait_us(saturated(record.encode_wait_us));
    header.set_encode_us(saturated(record.encode_us));
    header.set_send_wait_us(saturated(record.send_wait_us));
    if (record.compared) {
        fill(*header.mutable_compared(), *record.compared);
    }
    fillPasses(*header.mutable_passes(), record.stats);
    header.set_surfaces_kept(record.stats.surfaces_reused);
    fillLists(header, record.stats.lists);
    if (record.stats.grid.x > 0) {
        fill(*header.mutable_grid(), record.stats.grid);
    }
    for (const Stat& stat : record.stats.steps.all()) {
        if (!stat.row->field.empty()) {
            fill(header, stat);
        }
    }
    fillDelivery(header, record);
    header.set_full_size_us(saturated(record.full_size_us));
    header.set_dropped_frames(record.dropped_count);
    header.set_time_s(record.time_s);
    if (record.animation_time_s) {
        header.set_animation_time_s(*record.animation_time_s);
    }
    if (record.followed) {
        fill(*header.mutable_camera(), *record.followed);
    }
    header.set_triangles(record.stats.triangle_count);
    if (record.depth_mesh > 0) {
        header.set_depth_mesh(record.depth_mesh);
        fill(*header.mutable_picture_camera(), record.camera);
    }
    return header;
}

v1::DepthMeshHeader makeDepthMeshHeader(const protocol::CodedDepthMesh& mesh, uint64_t number) {
    v1::DepthMeshHeader header;
    header.set_number(number);
    header.set_columns(mesh.size.columns);
    header.set_rows(mesh.size.rows);
    header.set_bits(mesh.bits);
    header.set_nearest_per_m(mesh.nearest_per_m);
    header.set_cell_px(mesh.cell_px);
    return header;
}

} // namespace froxel::session
