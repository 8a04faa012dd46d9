// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/opened_scene.hpp>
#include <sinew/view/stage.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sinew::view {

struct ServeSettings {
  std::string title = "Sinew";
  std::string address = "127.0.0.1";  // where it listens; another one than that lets other machines in
  int port = 8765;                    // 0: any that is free
  std::string page{};                 // the folder of the page; empty: where it was built or installed
  int clients = 16;                   // the most that look at a time
  bool untilInterrupted = true;       // Ctrl-C ends it
  // Makes a scene of the files that somebody drops onto the page, which then takes the place of that which is
  // seen; one at a time, in a thread of its own. What it throws as Error is shown there. Without it a page
  // cannot open scenes.
  std::function<OpenedScene(std::vector<SceneFile> const& files)> open{};
};

/// Shows a stage in browsers: a web server for the page, and a WebSocket for what view/protocol.hpp says. All
/// lies behind a link with a random word, without which nothing is given, and pages of other sites get
/// nothing. All who look see the same stage; one who is slow gets newer pictures, and never keeps the others
/// waiting. Of the target sinew::serve.
class Server {
 public:
  /// Listens. Throws Error where the port is taken, or there is no page.
  explicit Server(Stage& stage, ServeSettings const& settings = {});
  ~Server();

  /// What a browser opens.
  std::string const& link() const;
  /// Serves until stop(), or Ctrl-C.
  void run();
  /// From any thread.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Prints the link to a stage, and serves it.
void serve(Stage& stage, ServeSettings const& settings = {});

/// Shows a simulation, which is initialised, in browsers until Ctrl-C: it stands at first, and the space bar
/// lets it go.
template <class Simulation>
void serve(Simulation& simulation, double dt, ServeSettings const& settings = {}) {
  Stage stage(simulation, dt);
  serve(stage, settings);
}

}  // namespace sinew::view
