#include "load/viewer.h"

#include "core/text.h"
#include "load/client_tls.h"
#include "load/opening.h"
#include "protocol/depth_mesh.h"
#include "protocol/framing.h"
#include "protocol/limits.h"
#include "session/proto_enums.h"
#include "session/settings.h"

#include <boost/asio/connect.hpp>
#include <boost/beast/http/field.hpp>

#include <utility>
#include <variant>

namespace froxel::load {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

namespace {

using namespace std::chrono_literals;

constexpr auto kConnectTimeout = 10s;
// Between the server's pings and ours a silent connection is found broken within this.
constexpr auto kIdleTimeout = 30s;
// Of the display that frames are painted on.
constexpr auto kRefresh = std::chrono::duration_cast<Clock::duration>(Seconds(1.0 / 60));
// As in the page: a camera on its way out behind this much would be old when it arrives.
constexpr size_t kMaxBacklogBytes = 16 * 1024;
// A server that reads nothing must not fill this process's memory.
constexpr size_t kMaxOutgoingBytes = 4 * 1024 * 1024;

// A full server declines whoever does not say that a room of its own is meant.
std::string resourceFor(const Target& target, const std::string& room) {
    const char* separator = target.resource.find('?') == std::string::npos ? "?" : "&";
    return room.empty() ? target.resource : target.resource + separator + "room=" + room;
}

} // namespace

Viewer::Viewer(asio::any_io_executor executor,
               const ViewerOptions& options,
               ViewerPlan plan,
               std::function<void(Event)> report)
    : options_(options), plan_(std::move(plan)), report_(std::move(report)), resolver_(executor),
      stream_(CountedTcp(executor), options.target.tls ? options.tls.get() : nullptr),
      deadline_(executor), leave_(executor), refresh_(executor), step_timer_(executor) {}

Viewer::~Viewer() = default;

void Viewer::start(TimePoint run_start) {
    const auto at = [run_start](Seconds time) {
        return run_start + std::chrono::duration_cast<Clock::duration>(time);
    };
    deadline_.expires_at(at(plan_.visit.join));
    deadline_.async_wait(guarded([](Viewer& self) { self.connect(); }));
    if (plan_.visit.leave) {
        leave_.expires_at(at(*plan_.visit.leave));
        leave_.async_wait(guarded([](Viewer& self) { self.end(Clock::now()); }));
    }
}

void Viewer::connect() {
    connecting_since_ = Clock::now();
    result_.tried = true;
    deadline_.expires_after(kFirstFrameTimeout);
    deadline_.async_wait(guarded([](Viewer& self) {
        if (!self.result_.first_frame_ms) {
            self.fail("no frame within " + numberText(kFirstFrameTimeout.count()) + " s");
        }
    }));
    const auto where = [this](const std::string& why) {
        return "cannot connect to " + printable(options_.target.authority) + ": " + why;
    };
    resolver_.async_resolve(
        options_.target.host, options_.target.port,
        [self = shared_from_this(), where](Code failure, const auto& addresses) {
            if (self->ended_) {
                return;
            }
            if (failure) {
                self->fail(where(failure.message()));
                return;
            }
            CountedTcp& socket = self->tcp();
            socket.expires_after(kConnectTimeout);
            socket.async_connect(addresses, [self, where](Code broken, const auto& /*address*/) {
                if (self->ended_) {
                    return;
                }
                if (broken) {
                    self->fail(where(broken.message()));
                } else {
                    self->onConnected();
                }
            });
        });
}

void Viewer::onConnected() {
    Code ignored; // a socket that closed meanwhile fails at its first read
    tcp().socket().set_option(asio::ip::tcp::no_delay(true), ignored);
    if (options_.target.tls) {
        secure();
    } else {
        upgrade();
    }
}

void Viewer::secure() {
    SSL* const tls = stream_.next_layer().tls();
    if (!expectHost(tls, options_.target.host)) {
        fail("TLS: no server can prove to be " + printable(options_.target.host, 200));
        return;
    }
    tcp().expires_after(kConnectTimeout);
    stream_.next_layer().async_handshake(
        asio::ssl::stream_base::client, [self = shared_from_this(), tls](Code failure) {
            if (self->ended_) {
                return;
            }
            if (failure) {
                self->fail("TLS with " + printable(self->options_.target.authority) +
                           " failed: " + whyRefused(tls, failure));
            } else {
                self->upgrade();
            }
        });
}

void Viewer::upgrade() {
    tcp().expires_never();
    stream_.set_option(websocket::stream_base::timeout{kConnectTimeout, kIdleTimeout,
                                                       /*keep_alive_pings=*/true});
    stream_.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
        request.set(
            beast::http::field::sec_websocket_protocol,
            beast::string_view(protocol::kSubprotocol.data(), protocol::kSubprotocol.size()));
    }));
    stream_.read_message_max(protocol::kMaxFrameBytes);
    stream_.binary(true);
    stream_.async_handshake(
        response_, options_.target.authority, resourceFor(options_.target, options_.room),
        [self = shared_from_this()](Code failure) {
            if (self->ended_) {
                return;
            }
            if (failure == websocket::error::upgrade_declined) {
                const bool full =
                    self->response_.result() == beast::http::status::service_unavailable;
                const std::string why = "no WebSocket at " +
                                        printable(self->options_.target.resource) + ": HTTP " +
                                        numberText(self->response_.result_int());
                if (full) {
                    self->refuse(why + ", the server is full or going down");
                } else {
                    self->fail(why);
                }
            } else if (failure) {
                self->fail("the WebSocket handshake failed: " + failure.message());
            } else {
                self->onUpgraded();
            }
        });
}

void Viewer::onUpgraded() {
    v1::ClientMessage message;
    message.mutable_hello()->set_protocol_major(protocol::kMajor);
    message.mutable_hello()->set_protocol_minor(protocol::kMinor);
    message.mutable_hello()->set_client_name("froxel load " + numberText(plan_.number));
    for (const settings::CodecRow& row : settings::kCodecRows) {
        if (row.announced) {
            message.mutable_hello()->add_codecs(
                session::toProto<v1::Codec>(settings::kCodecNames, row.codec));
        }
    }
    message.mutable_hello()->set_room(options_.room);
    if (const auto& tokens = options_.tokens; !tokens.empty()) {
        message.mutable_hello()->set_token(tokens[(plan_.number - 1) % tokens.size()]);
    }
    send(std::move(message), Clock::now());
    read();
}

void Viewer::read() {
    stream_.async_read(buffer_, [self = shared_from_this()](Code failure, size_t) {
        if (!self->ended_) {
            self->onRead(failure);
        }
    });
}

void Viewer::onRead(Code failure) {
    const TimePoint now = Clock::now();
    if (failure) {
        if (closing_) {
            finish();
        } else if (failure == websocket::error::closed) {
            const auto& reason = stream_.reason();
            fail("the server closed the connection with " + numberText(reason.code) + " " +
                 printable({reason.reason.data(), reason.reason.size()}, 123));
        } else {
            fail("the connection broke: " + failure.message());
        }
        return;
    }
    const auto data = buffer_.data();
    const protocol::ByteSpan message(static_cast<const std::byte*>(data.data()), data.size());
    const auto kind = protocol::binaryKind(message);
    if (stream_.got_text() || !kind) {
        fail(kind ? "a text message in answer to binary ones" : kind.error().message);
    } else if (*kind == protocol::Kind::kFrame) {
        onFrame(message, now);
    } else if (*kind == protocol::Kind::kDepth) {
        onDepth(message);
    } else {
        v1::ServerMessage decoded;
        const auto parsed =
            protocol::decodeServerMessage(message, protocol::WireFormat::kBinary, decoded);
        if (parsed) {
            onMessage(decoded, now);
        } else {
            fail(parsed.error().message);
        }
    }
    if (!ended_) {
        buffer_.consume(buffer_.size());
        read();
    }
}

void Viewer::onFrame(protocol::ByteSpan message, TimePoint now) {
    if (!welcome_) {
        fail("a frame before Welcome");
        return;
    }
    v1::FrameHeader header;
    const auto payload = protocol::decodeFrame(message, header);
    if (!payload) {
        fail(payload.error().message);
        return;
    }
    if (const auto picture = pictures_.onFrame(header, *payload); !picture) {
        fail("frame " + numberText(header.frame_id()) + ": " + picture.error().message);
        return;
    }
    if (header.depth_mesh() > depth_mesh_) {
        fail("frame " + numberText(header.frame_id()) + " is of depth mesh " +
             numberText(header.depth_mesh()) + ", which has not come");
        return;
    }
    if (const auto noted = meter_.onFrame(header, message.size(), sent_seq_, now); !noted) {
        fail(noted.error().message);
        return;
    }
    if (!result_.first_frame_ms && header.applied_seq() >= setup_seq_) {
        result_.first_frame_ms =
            std::chrono::duration<double, std::milli>(now - connecting_since_).count();
        deadline_.cancel();
        report_(Event::kJoined);
        if (plan_.measures_alone) {
            begin(now);
        }
    }
    paintLater(header.frame_id(), now);
}

void Viewer::onDepth(protocol::ByteSpan message) {
    v1::DepthMeshHeader header;
    const auto coded = protocol::decodeDepth(message, header);
    if (!coded) {
        fail(coded.error().message);
        return;
    }
    if (!options_.depth || header.number() <= depth_mesh_) {
        fail("depth mesh " + numberText(header.number()) +
             (options_.depth ? " after " + numberText(depth_mesh_) : " that nobody asked for"));
        return;
    }
    constexpr DepthMeshSize kMost(settings::kWidthRange.max, settings::kHeightRange.max);
    DepthMeshSize size;
    size.columns = header.columns();
    size.rows = header.rows();
    if (size.vertexCount() == 0 || size.columns > kMost.columns || size.rows > kMost.rows) {
        fail("a depth mesh of " + numberText(size.columns) + "x" + numberText(size.rows) +
             " vertices");
        return;
    }
    if (const auto steps = protocol::decodeDepthMesh(*coded, size, header.bits()); !steps) {
        fail(steps.error().message);
        return;
    }
    depth_mesh_ = header.number();
    meter_.onDepth(message.size());
}

void Viewer::onMessage(const v1::ServerMessage& message, TimePoint now) {
    if (message.has_welcome()) {
        onWelcome(message.welcome(), now);
    } else if (message.has_state()) {
        onState(message.state().state(), now);
    } else if (message.has_scene_changed()) {
        meter_.onScene(message.scene_changed().scene().id());
        onState(message.scene_changed().state(), now);
    } else if (message.has_error()) {
        meter_.onError(message.error());
        if (result_.first_frame_ms) {
            return;
        }
        const std::string why = "refused: " + printable(message.error().message(), 200);
        if (message.error().code() == v1::ERROR_CODE_CAPACITY) {
            refuse(why);
        } else {
            fail(why);
        }
    }
}

void Viewer::onState(const v1::ViewState& state, TimePoint now) {
    meter_.onState(state, now);
    if (!meter_.counting()) {
        state_ = state;
    }
}

void Viewer::onWelcome(const v1::Welcome& welcome, TimePoint now) {
    if (welcome_) {
        fail("Welcome came twice");
        return;
    }
    welcome_ = welcome;
    meter_.onScene(welcome.scene().id());
    onState(welcome.state(), now);
    result_.controlled = controls();
    if (options_.depth) {
        if (!welcome.offers_depth()) {
            fail("the server offers no depth");
            return;
        }
        v1::ClientMessage request;
        request.mutable_request_depth()->set_wanted(true);
        send(std::move(request), Clock::now());
    }
    if (controls()) {
        for (v1::ClientMessage& message : openingOf(options_, *welcome_->mutable_state())) {
            send(std::move(message), Clock::now());
            setup_seq_ = sent_seq_;
        }
    }
}

bool Viewer::controls() const {
    return !welcome_->has_room() || welcome_->room().controller() == welcome_->room().you();
}

void Viewer::paintLater(uint64_t frame_id, TimePoint now) {
    const Unpainted overtaken = std::exchange(unpainted_, {frame_id, now});
    if (overtaken.frame_id != 0) {
        meter_.onFrameDropped();
        acknowledge(overtaken);
        return;
    }
    // Refreshes come at whole periods of this viewer's own phase.
    refresh_.expires_at(now + (kRefresh - (now - connecting_since_) % kRefresh));
    refresh_.async_wait(
        guarded([](Viewer& self) { self.acknowledge(std::exchange(self.unpainted_, {})); }));
}

void Viewer::acknowledge(const Unpainted& frame) {
    if (!closing_) {
        v1::ClientMessage message;
        message.mutable_ack()->set_frame_id(frame.frame_id);
        message.mutable_ack()->set_receive_to_paint_us(frame.heldUs());
        send(std::move(message), Clock::now());
    }
}

void Viewer::begin(TimePoint now) {
    if (ended_ || !result_.first_frame_ms) {
        return;
    }
    meter_.begin(now, isRestless(plan_.script, options_.think));
    result_.served = servedOf(*welcome_, state_);
    received_before_ = traffic().receivedBytes();
    received_taken_ = received_before_;
    sent_before_ = traffic().sentBytes();
    script_ = makeScript(controls() ? plan_.script : ScriptChoice(Idle{}), *welcome_, plan_.number,
                         options_.think);
    script_start_ = now;
    playNext();
}

void Viewer::playNext() {
    step_ = script_->next();
    if (step_) {
        step_timer_.expires_at(script_start_ + step_->at);
        step_timer_.async_wait(guarded([](Viewer& self) { self.onStepDue(); }));
    }
}

void Viewer::onStepDue() {
    if (closing_) {
        return;
    }
    const TimePoint now = Clock::now();
    const TimePoint due = script_start_ + step_->at;
    if (step_->message.has_set_camera() && outgoing_bytes_ > kMaxBacklogBytes) {
        meter_.onCommandSkipped(sent_seq_ + 1, due);
    } else {
        meter_.onCommand(sent_seq_ + 1, step_->message, due, now);
        send(std::move(step_->message), now);
    }
    playNext();
}

void Viewer::send(v1::ClientMessage message, TimePoint now) {
    message.set_seq(++sent_seq_);
    message.set_client_time_us(ViewerMeter::stampOf(now));
    outgoing_.push_back(message.SerializeAsString());
    outgoing_bytes_ += outgoing_.back().size();
    if (outgoing_bytes_ > kMaxOutgoingBytes) {
        fail("the server reads nothing: " + numberText(outgoing_bytes_) + " bytes wait");
    } else if (outgoing_.size() == 1) {
        write();
    }
}

void Viewer::write() {
    stream_.async_write(asio::buffer(outgoing_.front()),
                        [self = shared_from_this()](Code failure, size_t) {
                            if (self->ended_ || failure) {
                                return; // the read under way says why
                            }
                            self->outgoing_bytes_ -= self->outgoing_.front().size();
                            self->outgoing_.pop_front();
                            if (!self->outgoing_.empty()) {
                                self->write();
                            }
                        });
}

void Viewer::endMeasuring(TimePoint now) {
    if (result_.tried && !result_.first_frame_ms && !result_.first_frame_wait_ms) {
        result_.first_frame_wait_ms =
            std::chrono::duration<double, std::milli>(now - connecting_since_).count();
    }
    if (meter_.counting()) {
        meter_.end(now);
        result_.received_bytes = traffic().receivedBytes() - received_before_;
        result_.sent_bytes = traffic().sentBytes() - sent_before_;
    }
}

void Viewer::end(TimePoint now) {
    if (ended_ || closing_) {
        return;
    }
    endMeasuring(now);
    closing_ = true;
    step_timer_.cancel();
    refresh_.cancel();
    if (!welcome_) {
        finish();
        return;
    }
    deadline_.expires_after(kCloseTimeout);
    deadline_.async_wait(guarded([](Viewer& self) { self.finish(); }));
    stream_.async_close(websocket::close_code::normal, [self = shared_from_this()](Code) {
        if (!self->ended_) {
            self->finish();
        }
    });
}

void Viewer::fail(const std::string& why) {
    if (ended_) {
        return;
    }
    if (!closing_) {
        result_.failure = why;
        endMeasuring(Clock::now());
    }
    finish();
}

void Viewer::refuse(const std::string& why) {
    result_.refused = true;
    fail(why);
}

void Viewer::finish() {
    ended_ = true;
    deadline_.cancel();
    leave_.cancel();
    refresh_.cancel();
    step_timer_.cancel();
    resolver_.cancel();
    tcp().close();
    if (!result_.first_frame_ms) {
        report_(Event::kJoined);
    }
    report_(result_.failure ? Event::kFailed : Event::kLeft);
}

ViewerChange Viewer::takeChange(TimePoint now) {
    ViewerChange change;
    change.number = plan_.number;
    change.tried = result_.tried;
    change.joining = result_.tried && !ended_ && !result_.first_frame_ms;
    change.watching = result_.first_frame_ms.has_value() && !closing_ && !ended_;
    change.failure = result_.failure;
    change.refused = result_.refused;
    change.first_frame_ms = result_.first_frame_ms;
    change.measured = meter_.takeNew(now);
    if (meter_.counting()) {
        change.waiting = meter_.waiting(now);
    }
    const uint64_t received =
        meter_.counting() ? traffic().receivedBytes() : received_before_ + result_.received_bytes;
    change.received_bytes = received - std::exchange(received_taken_, received);
    return change;
}

ViewerResult Viewer::result() const {
    ViewerResult result = result_;
    result.measured = meter_.measured();
    result.key_frames = pictures_.keyFrameCount();
    return result;
}

} // namespace froxel::load
