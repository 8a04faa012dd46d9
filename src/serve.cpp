// SPDX-License-Identifier: BSL-1.0
// Of sinew::serve: a stage in browsers, by Boost.Beast, which is compiled here only.
#include <sinew/version.hpp>
#include <sinew/view/protocol.hpp>
#include <sinew/view/serve.hpp>

#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <thread>

namespace sinew::view {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using Text = std::shared_ptr<std::string const>;
using Request = http::request<http::string_body>;

constexpr std::size_t mostReplies = 64;         // that wait for a client who does not read
constexpr std::size_t mostConnections = 64;     // at a time, beside those who look
constexpr std::size_t largestPage = 32u << 20;  // all files together [bytes]

Text shared(std::string&& text) { return std::make_shared<std::string const>(std::move(text)); }

std::string random_word() {
  std::random_device device;
  std::string word;
  for (int i = 0; i < 32; ++i) word += "0123456789abcdef"[device() % 16];
  return word;
}
// takes as long wherever the first difference is
bool same_word(std::string_view a, std::string_view b) {
  unsigned different = a.size() != b.size();
  for (std::size_t i = 0; i < b.size(); ++i)
    different |=
        unsigned(static_cast<unsigned char>(i < a.size() ? a[i] : '\0') ^ static_cast<unsigned char>(b[i]));
  return different == 0;
}

// ---- the files of the page

struct File {
  std::string type, content;
};
using Page = std::map<std::string, File, std::less<>>;

char const* type_of(std::filesystem::path const& file) {
  static const std::map<std::string, char const*> types{{".html", "text/html; charset=utf-8"},
                                                        {".js", "text/javascript; charset=utf-8"},
                                                        {".css", "text/css; charset=utf-8"},
                                                        {".wasm", "application/wasm"},
                                                        {".json", "application/json"},
                                                        {".svg", "image/svg+xml"},
                                                        {".txt", "text/plain; charset=utf-8"}};
  const auto at = types.find(file.extension().string());
  return at == types.end() ? nullptr : at->second;
}

// beside the program where that is installed, or where it was built
std::filesystem::path usual_page() {
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto installed = program.parent_path().parent_path() / "share/sinew/page";
  if (!none && std::filesystem::exists(installed / "index.html", none)) return installed;
#if defined(SINEW_PAGE)
  return SINEW_PAGE;
#else
  return installed;
#endif
}

// all files of a folder are read once: what is asked for later is one of them or nothing
Page read_page(std::string const& asked, bool opens) {
  const std::filesystem::path folder = asked.empty() ? usual_page() : std::filesystem::path(asked);
  std::error_code missing;
  if (!std::filesystem::exists(folder / "index.html", missing))
    throw Error("serve",
                text("the folder '",
                     folder.string(),
                     "' has no page (index.html); ./dev serve builds it in the sources of Sinew, "
                     "and --page names another folder"));
  Page page;
  std::size_t size = 0;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) {
    char const* type = type_of(entry.path());
    if (!type || !entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    File read{type, std::move(content).str()};
    if ((size += read.content.size()) > largestPage)
      throw Error("serve", text("the folder '", folder.string(), "' is no page: its files are too large"));
    page.emplace(entry.path().filename().string(), std::move(read));
  }
  // the page asks what runs its scene; as a folder of files it is Sinew in WebAssembly
  page["engine.json"] = {type_of("engine.json"),
                         opens ? R"({"engine": "socket", "opens": true})" : R"({"engine": "socket"})"};
  return page;
}

// ---- who looks

class Viewer;
class Visitor;

// What all connections share; they are in one thread.
struct Shared {
  Stage* stage;
  ServeSettings settings;
  Page page = read_page(settings.page, bool(settings.open));
  std::string word = random_word();
  std::set<std::string> hosts{};  // by which browsers may call it; empty: by any
  Text scene{};
  std::set<Viewer*> viewers{};
  std::size_t connections = 0;
  Viewer* puller = nullptr;  // whose pointer holds something
  std::function<void()> look{};
  std::function<void(std::vector<SceneFile>, std::shared_ptr<Visitor>)> open{};
  bool opens = false;  // a scene is being opened, or one that was seen goes

  std::uint32_t topologyNumber = 0, texturesNumber = 0;
  Text textures{}, topology{}, frame{}, state{};
};
using Everything = std::shared_ptr<Shared>;

// A connection that is counted as long as it lives.
struct Counted {
  Everything all;
  explicit Counted(Everything a) : all(std::move(a)) { ++all->connections; }
  Counted(Counted const&) = delete;
  Counted& operator=(Counted const&) = delete;
  ~Counted() { --all->connections; }
};

// A browser at the WebSocket. What is to be sent waits in one place for each kind, where what is newer takes
// the place of what is older; only replies to mistakes queue up, and not many.
class Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  Viewer(tcp::socket&& socket, Everything all) : counted_(std::move(all)), socket_(std::move(socket)) {}

  void accept(Request const& request) {
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(longestCommand);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return;
      self->scene_ = self->all().scene;
      self->all().viewers.insert(self.get());
      self->offer();
      self->read();
      self->all().look();
    });
  }
  // there is another scene to be seen
  void restart() {
    scene_ = all().scene;
    frame_.reset(), state_.reset(), topology_.reset(), textures_.reset();
    offer();
  }
  // the latest of what is to be seen
  void offer() {
    Shared& now = all();
    if (now.frame && now.frame != sentFrame_)
      frame_ = now.frame, topology_ = now.topology, textures_ = now.textures;
    if (now.state && now.state != sentState_) state_ = now.state;
    write();
  }
  void close() { beast::get_lowest_layer(socket_).close(); }

 private:
  Counted counted_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_{};
  std::deque<Text> replies_{};
  Text scene_{}, textures_{}, topology_{}, frame_{}, state_{}, writing_{};
  Text sentTextures_{}, sentTopology_{}, sentFrame_{}, sentState_{};

  Shared& all() { return *counted_.all; }

  void read() {
    buffer_.clear();
    socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->leave();
      self->obey();
      self->read();
    });
  }
  void obey() {
    try {
      if (!socket_.got_text()) throw Error("command", "it is no text; commands are JSON");
      const auto bytes = buffer_.cdata();
      const Command said =
          read_command(std::string_view(static_cast<char const*>(bytes.data()), bytes.size()));
      if (std::holds_alternative<command::Press>(said)) all().puller = this;
      // the stage answers in its own thread, and perhaps when nobody is here any more
      auto answer = [weak = weak_from_this(), executor = socket_.get_executor()](std::string json) {
        asio::post(executor, [weak, text = shared(std::move(json))] {
          if (const auto self = weak.lock()) self->reply(text);
        });
      };
      tell(*all().stage, said, answer);
      all().look();
    } catch (Error const& error) {
      reply(shared(write_error(error.what())));
    }
  }
  void reply(Text text) {
    if (replies_.size() >= mostReplies) return close();
    replies_.push_back(std::move(text));
    write();
  }
  // what it holds falls
  void leave() {
    if (!all().viewers.erase(this)) return;
    if (all().puller == this) {
      all().puller = nullptr;
      all().stage->release();
    }
    replies_.clear();
  }
  void write() {
    if (writing_) return;
    bool binary = false;
    if (scene_) {
      writing_ = std::exchange(scene_, {});
    } else if (!replies_.empty()) {
      writing_ = std::move(replies_.front());
      replies_.pop_front();
    } else if (frame_) {
      binary = true;
      if (textures_ != sentTextures_)
        writing_ = sentTextures_ = textures_;
      else if (topology_ != sentTopology_)
        writing_ = sentTopology_ = topology_;
      else
        writing_ = sentFrame_ = std::exchange(frame_, {});
    } else if (state_) {
      writing_ = sentState_ = std::exchange(state_, {});
    } else {
      return;
    }
    socket_.binary(binary);
    socket_.async_write(asio::buffer(*writing_), [self = shared_from_this()](error_code error, std::size_t) {
      self->writing_.reset();
      if (error) return self->leave();
      self->write();
    });
  }
};

// A browser that asks for files, and then for the WebSocket.
class Visitor : public std::enable_shared_from_this<Visitor> {
 public:
  Visitor(tcp::socket&& socket, Everything all) : counted_(std::move(all)), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(16384);
    parser_->body_limit(longestUpload);  // which its header is compared with
    stream_.expires_after(std::chrono::seconds(20));
    http::async_read_header(
        stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
          if (error == http::error::body_limit && self->isUpload(self->parser_->get()))
            return self->refuseSize();
          if (error) return;
          if (self->isUpload(self->parser_->get())) {
            self->stream_.expires_after(std::chrono::seconds(60));
          } else {
            constexpr std::size_t most = 1024;
            if (self->parser_->content_length().value_or(0) > most) return;
            self->parser_->body_limit(most);
          }
          self->readBody();
        });
  }
  // what has come of the scene that it sent: what was noticed, or an error
  void opened(bool good, std::string const& words) {
    reply(request_, good ? http::status::ok : http::status::unprocessable_entity, words);
  }

 private:
  Counted counted_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{};
  std::optional<http::request_parser<http::string_body>> parser_{};
  http::response<http::string_body> response_{};
  Request request_{};  // whose answer takes time

  Shared& all() { return *counted_.all; }

  void readBody() {
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error == http::error::body_limit && self->isUpload(self->parser_->get())) return self->refuseSize();
      if (error) return;
      self->answer(self->parser_->release());
    });
  }
  void refuseSize() {
    reply(parser_->get(),
          http::status::payload_too_large,
          text("these files are too large; ", longestUpload >> 20, " MB are allowed\n"));
  }
  // a scene from the page of this server itself
  bool isUpload(Request const& request) {
    const std::string_view host = view(request[http::field::host]);
    std::string_view target = view(request.target());
    if (request.method() != http::verb::post || !target.starts_with('/')) return false;
    target.remove_prefix(1);
    const std::size_t slash = target.find('/');
    return slash != target.npos && target.substr(slash) == "/scene" && all().settings.open &&
           (all().hosts.empty() || all().hosts.contains(std::string(host))) &&
           same_word(target.substr(0, slash), all().word) &&
           view(request[http::field::origin]) == "http://" + std::string(host);
  }

  static std::string_view view(beast::string_view s) { return {s.data(), s.size()}; }

  void take(Request request) {
    if (all().opens)
      return reply(
          request, http::status::service_unavailable, "another scene is being opened; wait for it\n");
    std::vector<SceneFile> files;
    try {
      files = read_upload(request.body());
    } catch (Error const& error) {
      return reply(request, http::status::bad_request, text(error.what(), '\n'));
    }
    request.body().clear();
    request_ = std::move(request);
    stream_.expires_never();  // it takes as long as the scene needs
    all().open(std::move(files), shared_from_this());
  }
  void answer(Request request) {
    if (isUpload(request)) return take(std::move(request));
    const std::string_view host = view(request[http::field::host]);
    std::string_view target = view(request.target());
    target = target.substr(0, target.find('?'));
    if (!target.starts_with('/')) return reply(request, http::status::bad_request, "this is no path\n");
    target.remove_prefix(1);
    const std::size_t slash = target.find('/');
    const std::string_view word = target.substr(0, slash);
    // a page of another site may know the address, and call it by a name of its own; it knows no word
    if (!all().hosts.empty() && !all().hosts.contains(std::string(host)))
      return reply(request, http::status::forbidden, "it is called by another name\n");
    if (!same_word(word, all().word))
      return reply(
          request, http::status::forbidden, "this needs the whole link that 'sinew serve' printed\n");
    const std::string_view name = slash == target.npos ? std::string_view() : target.substr(slash + 1);
    if (websocket::is_upgrade(request)) return look(request, name, host);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return reply(request, http::status::method_not_allowed, "files can be read, and no more\n");
    if (slash == target.npos) {  // names in the page are relative to the folder
      response_ = {http::status::moved_permanently, request.version()};
      response_.set(http::field::location, "/" + all().word + "/");
      return send(request);
    }
    const auto file = all().page.find(name.empty() ? std::string_view("index.html") : name);
    if (file == all().page.end()) return reply(request, http::status::not_found, "there is no such file\n");
    response_ = {http::status::ok, request.version()};
    response_.set(http::field::content_type, file->second.type);
    response_.set("Content-Security-Policy",
                  "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self' ws://" +
                      std::string(host) + "; img-src 'self' data: blob:; frame-ancestors 'none'");
    response_.body() = file->second.content;
    send(request);
  }
  void look(Request const& request, std::string_view name, std::string_view host) {
    if (name != "stage") return reply(request, http::status::not_found, "there is no such socket\n");
    const auto origin = request.find(http::field::origin);
    if (origin != request.end() && view(origin->value()) != "http://" + std::string(host))
      return reply(request, http::status::forbidden, "pages of other sites get nothing\n");
    if (all().viewers.size() >= std::size_t(all().settings.clients))
      return reply(request, http::status::service_unavailable, "too many look at it already\n");
    stream_.expires_never();
    std::make_shared<Viewer>(stream_.release_socket(), counted_.all)->accept(request);
  }
  void reply(Request const& request, http::status status, std::string const& why) {
    response_ = {status, request.version()};
    response_.set(http::field::content_type, "text/plain; charset=utf-8");
    response_.body() = why;
    send(request);
  }
  void send(Request const& request) {
    stream_.expires_after(std::chrono::seconds(20));
    response_.set(http::field::server, "sinew/" SINEW_VERSION);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    const bool stays = request.keep_alive() && response_.result() == http::status::ok;
    response_.keep_alive(stays);
    response_.prepare_payload();
    if (request.method() == http::verb::head) response_.body().clear();
    http::async_write(stream_, response_, [self = shared_from_this(), stays](error_code error, std::size_t) {
      if (error) return;
      if (stays) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }
};

}  // namespace

struct Server::Parts {
  asio::io_context context{1};
  Everything all;
  tcp::acceptor acceptor{context};
  asio::steady_timer timer{context}, pause{context};
  asio::signal_set signals{context};
  std::string link{};
  Stage::Scene seen{};
  SceneWriter writer{};
  bool waits = false;  // for the time to look again
  std::chrono::steady_clock::time_point changed{};
  std::shared_ptr<Stage> own{};  // of a scene that was opened
  std::thread worker{};          // opens one, and lets the one before go

  Parts(Stage& stage, ServeSettings const& settings) : all(new Shared{&stage, settings}) {
    all->scene = shared(write_scene(settings.title, stage.dt(), stage.tree));
    all->look = [this] { lookSoon(); };
    all->open = [this](std::vector<SceneFile> files, std::shared_ptr<Visitor> from) {
      open(std::move(files), std::move(from));
    };
    listen();
    accept();
    if (settings.untilInterrupted) {
      signals.add(SIGINT);
      signals.add(SIGTERM);
      signals.async_wait([this](error_code error, int) {
        if (!error) context.stop();
      });
    }
  }
  ~Parts() {
    if (worker.joinable()) worker.join();
    // what still waits in the context refers to all of this
    for (Viewer* viewer : std::set<Viewer*>(all->viewers)) viewer->close();
    all->viewers.clear();
  }

  void listen() {
    ServeSettings const& s = all->settings;
    error_code error;
    const auto address = asio::ip::make_address(s.address, error);
    if (error) throw Error("serve", text("'", s.address, "' is no address; give one like 127.0.0.1"));
    if (s.port < 0 || s.port > 65535)
      throw Error("serve", text("the port is ", s.port, " and must be from 0 to 65535"));
    if (s.clients < 1) throw Error("serve", "at least one client must be allowed");
    const tcp::endpoint end(address, static_cast<unsigned short>(s.port));
    acceptor.open(end.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(end, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use)
      throw Error("serve",
                  text("port ",
                       s.port,
                       " is in use, perhaps by another 'sinew serve'; end that, or take another port "
                       "(--port), or 0 for any that is free"));
    if (error)
      throw Error("serve",
                  text("cannot listen at ",
                       s.address,
                       ", port ",
                       s.port,
                       " (",
                       error.message(),
                       "); take another address or port"));
    const std::string port = std::to_string(acceptor.local_endpoint().port());
    const std::string name = address.is_v6() ? "[" + s.address + "]" : s.address;
    // elsewhere a machine may have any name
    if (address.is_loopback())
      for (std::string const& host :
           {name, std::string("127.0.0.1"), std::string("localhost"), std::string("[::1]")})
        all->hosts.insert(host + ":" + port);
    link = "http://" + (address.is_unspecified() ? asio::ip::host_name() : name) + ":" + port + "/" +
           all->word + "/";
  }
  void accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // of files that may be open, for example
        pause.expires_after(std::chrono::milliseconds(100));
        pause.async_wait([this](error_code e) {
          if (!e) accept();
        });
        return;
      }
      if (all->connections < mostConnections + std::size_t(all->settings.clients)) {
        error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<Visitor>(std::move(socket), all)->read();
      }
      accept();
    });
  }

  // the others look on meanwhile
  void open(std::vector<SceneFile> files, std::shared_ptr<Visitor> from) {
    all->opens = true;
    if (worker.joinable()) worker.join();  // it has ended
    worker = std::thread([this, files = std::move(files), from = std::move(from)]() mutable {
      auto scene = std::make_shared<OpenedScene>();
      std::string words;
      try {
        *scene = all->settings.open(files);
        for (std::string const& note : scene->notes) words += note + '\n';
      } catch (std::exception const& error) {
        words = text(error.what(), '\n');
        scene.reset();
      }
      // the visitor belongs to the thread of the server, here and where nobody answers any more
      asio::post(context, [this, scene, words, from = std::move(from)] {
        if (scene) show(*scene);
        if (!scene) all->opens = false;
        from->opened(bool(scene), words);
      });
    });
  }
  void show(OpenedScene const& scene) {
    all->stage->release();
    all->stage->play(false);
    all->puller = nullptr;
    std::shared_ptr<Stage> gone = std::exchange(own, scene.stage);
    all->stage = own.get();
    all->scene = shared(write_scene(scene.title, own->dt(), own->tree));
    seen.reset();
    all->frame.reset(), all->state.reset();
    for (Viewer* viewer : all->viewers) viewer->restart();
    lookSoon();
    // it waits for the step that goes on
    worker.join();
    worker = std::thread([this, gone = std::move(gone)]() mutable {
      gone.reset();
      asio::post(context, [this] { all->opens = false; });
    });
  }

  // at the rate of displays while something changes, and now and then otherwise
  void lookSoon() {
    constexpr std::chrono::milliseconds soon(2);
    if (!waits || timer.expiry() > std::chrono::steady_clock::now() + soon) lookIn(soon);
  }
  void lookIn(std::chrono::milliseconds time) {
    waits = true;
    timer.expires_after(time);
    timer.async_wait([this](error_code error) {
      if (error) return;
      waits = false;
      look();
    });
  }
  void look() {
    if (all->viewers.empty()) return;  // until somebody comes
    const StageState state = all->stage->state();
    if (Stage::Scene latest = all->stage->scene(); latest != seen) {
      seen = std::move(latest);
      writer.write(*seen);
      if (writer.texturesNumber() != all->texturesNumber) {
        all->texturesNumber = writer.texturesNumber();
        all->textures = shared(std::string(writer.textures()));
      }
      if (writer.number() != all->topologyNumber) {
        all->topologyNumber = writer.number();
        all->topology = shared(std::string(writer.topology()));
      }
      if (!all->frame || *all->frame != writer.frame()) all->frame = shared(std::string(writer.frame()));
    }
    if (std::string json = write_state(state, *seen); !all->state || *all->state != json) {
      all->state = shared(std::move(json));
      changed = std::chrono::steady_clock::now();
    }
    for (Viewer* viewer : all->viewers) viewer->offer();
    const bool still = std::chrono::steady_clock::now() - changed > std::chrono::seconds(1);
    lookIn(std::chrono::milliseconds(still ? 100 : 16));
  }
};

Server::Server(Stage& stage, ServeSettings const& settings)
    : parts_(std::make_unique<Parts>(stage, settings)) {}
Server::~Server() = default;
std::string const& Server::link() const { return parts_->link; }
void Server::run() { parts_->context.run(); }
void Server::stop() { parts_->context.stop(); }

void serve(Stage& stage, ServeSettings const& settings) {
  Server server(stage, settings);
  std::printf("%s\nopen this link in a browser; Ctrl-C ends it\n", server.link().c_str());
  std::fflush(stdout);
  server.run();
}

}  // namespace sinew::view
