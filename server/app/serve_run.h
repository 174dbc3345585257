// A running server put together from its rooms: network, render loop, encoders. Tests run it with
// a frame source of their own; serve_command.cpp with the real one.
#pragma once

#include "app/device_losses.h"
#include "catalogue/catalogue.h"
#include "catalogue/folder_watch.h"
#include "core/file_stamp.h"
#include "encode/encode_pool.h"
#include "guest/guest_scene.h"
#include "net/server.h"
#include "session/session_context.h"
#include "stream/render_loop.h"
#include "stream/scene_host.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace froxel::app {

// Reads another scene, as stream::SceneHostOptions::read.
using ReadOther = std::function<Result<stream::ReadScene>(const catalogue::Offered&,
                                                          const ProgressReport& report)>;
using ReadGuest = std::function<Result<stream::ReadScene>(
    const std::shared_ptr<const guest::GuestScene>&, const ProgressReport& report)>;

// A scene on a device, ready to be drawn.
struct OpenedScene {
    std::unique_ptr<stream::FrameSource> source;
    session::SessionContext context;
    std::function<std::vector<MemoryUse>()> memory; // what the device's is used for; any thread
    Seconds step_limit{0};            // of the render thread, see net::Serving; 0: none
    std::vector<StampedFile> files{}; // scene::Scene
    ReadOther read_other{};           // null: there is no catalogue
    ReadGuest read_guest{};           // null: clients bring none
    uint64_t scene_bytes = 0;         // that others may take of the device's memory, together
};

struct ServeRunOptions {
    net::ServerOptions server;
    uint32_t encoder_count = 1;
    bool offers_depth = true;                        // as net::Serving
    std::shared_ptr<DeviceLosses> losses;            // null: they are not noted
    std::shared_ptr<catalogue::Catalogue> catalogue; // null: the server has one scene of its own
    // Runs on the render thread while the server already listens. May throw.
    std::function<OpenedScene(const ProgressReport& report)> open;
    // The scene could not be opened or the device was lost. On the render thread; must not throw.
    std::function<void(const Error&)> on_failure;
};

class ServeRun {
  public:
    // Listens when it returns. Throws StartupError: kAddressInUse, kIo.
    explicit ServeRun(ServeRunOptions options);
    // Ends at once; shutDown() before it is the polite way.
    ~ServeRun();
    ServeRun(const ServeRun&) = delete;
    ServeRun& operator=(const ServeRun&) = delete;

    [[nodiscard]] uint16_t port() const { return server_->port(); }
    // None without an admin address.
    [[nodiscard]] std::optional<uint16_t> adminPort() const { return server_->adminPort(); }
    // Whether the scene is open; until then the render thread cannot be stopped.
    [[nodiscard]] bool opened() const { return server_->service().status().serving.has_value(); }
    // As net::Server.
    bool drain(std::chrono::milliseconds deadline) { return server_->drain(deadline); }
    // As stream::RenderLoop.
    void stop() { loop_.stop(); }
    // Closes the connections whose token was taken away; after the gate has loaded.
    void checkTokens() { server_->service().announce(); }
    // Looks at the folder of scenes again; any thread.
    void rescan();
    // The device is gone: notes it, and tells every viewer.
    void giveUp(const std::string& why);
    // Whether the render thread moves; an error says for how long it has not.
    [[nodiscard]] Result<void> rendersOn() const;

  private:
    [[nodiscard]] stream::RenderLoopOptions loopOptions();
    [[nodiscard]] std::shared_ptr<stream::SceneHost> makeScenes();
    [[nodiscard]] Result<stream::ReadScene> readScene(const std::string& id,
                                                      const ProgressReport& report);
    // On the render thread.
    [[nodiscard]] std::unique_ptr<stream::FrameSource>
    open(const std::shared_ptr<const Heartbeat>& heartbeat);

    ServeRunOptions options_;
    encode::EncodePool pool_;
    // Both set before the first scene is asked for.
    ReadOther read_other_;
    ReadGuest read_guest_;
    const std::shared_ptr<stream::SceneHost> scenes_;
    std::unique_ptr<net::Server> server_; // goes after the loop has stopped and before it is gone
    stream::RenderLoop loop_;
    std::optional<catalogue::FolderWatch> watch_;
};

} // namespace froxel::app
