// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/drawn_marks.hpp>
#include <sinew/view/gl_objects.hpp>
#include <sinew/view/occlusion.hpp>
#include <sinew/view/overlay.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/shaded_mesh.hpp>
#include <sinew/view/shaders.hpp>
#include <sinew/view/smooth_target.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::view {

/// Draws scenes with OpenGL 3.3 into the frame buffer that is bound; the context in which it is made is
/// current.
class Renderer {
 public:
  /// Brings what is seen onto the graphics card.
  void show(SeenScene const& scene) {
    auto const& [low, high] = scene.box();
    centre_ = (low + high) / 2;
    radius_ = std::max((high - low).norm() / 2, 1e-9);
    std::size_t used = 0;
    for (SeenBody const& seen : scene.bodies) {
      if (!seen.visible) continue;
      if (used == bodies_.size()) bodies_.emplace_back();
      Body& body = bodies_[used++];
      body.opacity = seen.opacity;
      if (body.shaded.update(seen, scene.legend, scene.settings, 6 * shadow_.texel(radius_)))
        body.drawn.set(body.shaded.mesh());
      body.setMaterial(seen);
    }
    bodies_.resize(used);
    DrawnMarks marks = drawn_marks(scene, radius_);
    marks_.set(marks.mesh);
    labels_ = std::move(marks.labels);
    words_ = std::move(marks.words);
    legend_ = scene.settings.legend ? scene.legend : std::nullopt;
    if (!scene.settings.legend) words_.clear();
    up_ = scene.up;
    clip_ = scene.settings.clip;
    shadows_ = scene.settings.shadows;
    occludes_ = scene.settings.occlusion;
    lights_ = scene.settings.lights;
    if (lights_.size() > mostLights) lights_.resize(mostLights);
    ambient_ = scene.settings.ambient;
    colour_ = scene.settings.background.value_or(Eigen::Vector3d(background.data()));
  }

  /// `left`: the pixels that are left free beside the picture.
  void draw(Camera const& camera, int width, int height, int left = 0) {
    const Eigen::Matrix4d toView = camera.toView(), toClip = camera.toClip(double(width) / height);
    std::vector<SeenLight> lights = lights_;
    if (lights.empty())  // from the left above the eye
      lights.push_back(
          {.direction = (0.6 * camera.toEye - 0.5 * camera.right() + 0.7 * camera.above()).normalized()});
    // the first one from far away has a shadow
    const auto first = std::find_if(lights.begin(), lights.end(), [](SeenLight const& light) {
      return light.kind == SeenLight::Kind::parallel && !light.movesWithCamera;
    });
    const bool hasShadow = shadows_ && first != lights.end();
    const Eigen::Matrix4d toLight =
        first != lights.end() ? lightOf(first->direction) : Eigen::Matrix4d::Identity().eval();
    GLint target = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    if (clip_) glEnable(GL_CLIP_DISTANCE0);
    if (hasShadow) drawShadow(toLight);
    if (occludes_) findOcclusion(toView, toClip, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, GLuint(target));

    glViewport(left, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glClearColor(GLfloat(colour_[0]), GLfloat(colour_[1]), GLfloat(colour_[2]), 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, shadow_.depth);
    const std::string words = detail::words_of_lights(
        lights, hasShadow ? std::optional(std::size_t(first - lights.begin())) : std::nullopt);
    if (!lit_ || lit_->words != words || lit_->occludes != occludes_) lit_.emplace(words, occludes_);
    GlShaders const &surface = lit_->surface, &fine = lit_->fine;
    std::vector<GlShaders const*> lit{&surface, &fine};
    if (std::any_of(bodies_.begin(), bodies_.end(), [](Body const& body) { return body.ofMaterial; }))
      lit.push_back(&lit_->ofMaterials());
    for (GlShaders const* shaders : lit) {
      shaders->use();
      shaders->set("toView", toView);
      shaders->set("toClip", toClip);
      shaders->set("toLight", Eigen::Matrix4d(toLight * toView.inverse()));
      shaders->set("clip", clipped());
      setLights(*shaders, lights, toView);
      shaders->set("upAtEye", toView.topLeftCorner<3, 3>() * up_);
      shaders->setTexture("shadow", 0);
      if (!occludes_) continue;
      shaders->setTexture("open", 2);
      shaders->set("corner", Eigen::Vector2d(left, 0));
      shaders->set("occludes", 1);
    }
    glEnable(GL_POLYGON_OFFSET_FILL);  // edges are seen on the faces they belong to
    glPolygonOffset(1, 1);
    auto drawFaces = [&](Body const& body) {
      // what is hidden is known of pixels
      const bool isFineHere = !occludes_ && isFine(body.shaded.mesh(), camera, height);
      GlShaders const& shaders = body.ofMaterial ? *lit.back() : isFineHere ? fine : surface;
      shaders.use();
      shaders.set("opacity", body.opacity);
      if (occludes_) shaders.set("occludes", body.seenThrough() ? 0 : 1);
      if (body.ofMaterial) {
        shaders.set("specular", body.specular);
        shaders.set("shininess", body.shininess);
        shaders.setTexture("image", 1);
        glActiveTexture(GL_TEXTURE1);
        glBindTexture(GL_TEXTURE_2D, body.image ? body.texture : white_);
        glActiveTexture(GL_TEXTURE0);
      }
      body.drawn.faces.draw(GL_TRIANGLES);
    };
    for (Body const& body : bodies_)
      if (!body.seenThrough()) drawFaces(body);
    surface.use();
    surface.set("opacity", 1);
    surface.set("clip", everything());  // marks are seen as a whole
    if (occludes_) surface.set("occludes", 1);
    marks_.faces.draw(GL_TRIANGLES);
    glDisable(GL_POLYGON_OFFSET_FILL);
    plain_.use();
    plain_.set("toView", toView);
    plain_.set("toClip", toClip);
    plain_.set("clip", clipped());
    plain_.set("pointSize", std::max(4., height / 90.));
    auto drawThin = [&](Drawn const& drawn, double opacity) {
      plain_.set("opacity", opacity);
      plain_.set("roundPoints", 0);
      drawn.lines.draw(GL_LINES);
      plain_.set("roundPoints", 1);
      drawn.points.draw(GL_POINTS);
    };
    for (Body const& body : bodies_)
      if (!body.seenThrough()) drawThin(body.drawn, 1);
    plain_.set("clip", everything());
    drawThin(marks_, 1);
    plain_.set("clip", clipped());
    surface.use();
    surface.set("clip", clipped());
    drawSeenThrough(camera, drawFaces, [&](Body const& body) {
      plain_.use();
      drawThin(body.drawn, body.opacity);
    });
    glDisable(GL_CLIP_DISTANCE0);
    drawWords(camera, width, height);
  }

  std::array<double, 3> background{1, 1, 1};
  static constexpr double occlusionRadius = 0.15;  // in which light is hidden, by that of the scene

 private:
  struct Drawn {
    GlMesh faces{4}, lines{2}, points{2};

    void set(ShadedMesh const& mesh) {
      faces.set(mesh.corners, mesh.normals, mesh.colours, mesh.texcoords);
      faces.setIndices(mesh.triangles);
      faces.setIndices(mesh.casters, 1);
      lines.set(mesh.lines.at, mesh.lines.colours);
      points.set(mesh.points.at, mesh.points.colours);
    }
  };
  struct Body {
    ShadedBody shaded{};
    Drawn drawn{};
    double opacity = 1;
    bool ofMaterial = false;  // one that mirrors in its own way, or has a texture
    Eigen::Vector3d specular{0, 0, 0};
    double shininess = 1;
    std::shared_ptr<SeenTexture const> image{};
    GlTexture texture{};  // of it

    bool seenThrough() const { return opacity < 1; }
    void setMaterial(SeenBody const& seen) {
      const bool textured = seen.texture && !shaded.mesh().texcoords.empty();
      specular = seen.specular, shininess = seen.shininess;
      ofMaterial = textured || specular != SeenBody::plainSpecular || shininess != SeenBody::plainShininess;
      if (!textured) {
        image.reset(), texture = {};
      } else if (image != seen.texture) {
        image = seen.texture;
        texture = texture_of(image->width, image->height, image->rgba);
      }
    }
  };
  struct Shadow {
    static constexpr double margin = 1.05;  // seen around the scene, times its radius
    int size = 2048;
    GlTexture depth = detail::made<GlTexture>([](auto n, auto* id) { glGenTextures(n, id); });
    GlFrame frame = detail::made<GlFrame>([](auto n, auto* id) { glGenFramebuffers(n, id); });

    Shadow() {
      // without a graphics card a finer one takes most of the time
      if (drawn_by_software()) size = 1024;
      glBindTexture(GL_TEXTURE_2D, depth);
      glTexImage2D(
          GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
      auto set = [](GLenum what, GLint to) { glTexParameteri(GL_TEXTURE_2D, what, to); };
      set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
      set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
      set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
      set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
      set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
      glBindFramebuffer(GL_FRAMEBUFFER, frame);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
      glDrawBuffer(GL_NONE);
      glReadBuffer(GL_NONE);
    }
    double texel(double radius) const { return 2 * margin * radius / size; }  // [m]
  };
  // for the lights that there are: a shader that asks which ones is slow without a graphics card
  struct Lit {
    GlShaders surface, fine;
    std::optional<GlShaders> material{};  // of bodies of one, where there is any
    std::string words;
    bool occludes;

    Lit(std::string const& lights, bool occluded)
        : surface(detail::surfaceVertex,
                  light(lights, detail::plainMirror, detail::surfaceFragment, occluded)),
          fine(light(lights, detail::plainMirror, detail::fineVertex, false), detail::fineFragment),
          words(lights),
          occludes(occluded) {}
    GlShaders const& ofMaterials() {
      if (!material)
        material.emplace(detail::texturedVertex,
                         light(words, detail::materialMirror, detail::texturedFragment, occludes));
      return *material;
    }
    static std::string light(std::string const& lights, std::string_view mirror, std::string_view main,
                             bool occluded) {
      return text(detail::lightWords,
                  lights,
                  mirror,
                  occluded ? detail::openWords : detail::allOpenWords,
                  detail::litWords,
                  main);
    }
  };
  std::optional<Lit> lit_{};
  GlShaders depth_{detail::shadowVertex, detail::shadowFragment};
  GlShaders plain_{detail::plainVertex, detail::plainFragment};
  Shadow shadow_{};
  std::optional<Occlusion> occlusion_{};                      // where it was asked for
  GlTexture white_ = texture_of(1, 1, {255, 255, 255, 255});  // of materials without one
  std::vector<Body> bodies_{};
  Drawn marks_{};
  GlMesh overlay_{2};
  std::vector<std::pair<Eigen::Vector3d, std::string>> labels_{};
  std::vector<std::string> words_{};
  std::optional<Legend> legend_{};
  std::optional<ClipPlane> clip_{};
  Eigen::Vector3d up_{0, 1, 0}, centre_{0, 0, 0}, colour_{1, 1, 1};
  double radius_ = 1;
  bool shadows_ = true, occludes_ = false;
  std::vector<SeenLight> lights_{};
  std::optional<Eigen::Vector3d> ambient_{};

  void setLights(GlShaders const& shaders, std::vector<SeenLight> const& lights,
                 Eigen::Matrix4d const& toView) const {
    std::vector<Eigen::Vector4f> places, colours, cones, falls;
    for (SeenLight const& light : lights) {
      const Eigen::Matrix4d own = light.movesWithCamera ? Eigen::Matrix4d::Identity().eval() : toView;
      const Eigen::Vector3d direction = own.topLeftCorner<3, 3>() * light.direction;
      const bool parallel = light.kind == SeenLight::Kind::parallel,
                 spot = light.kind == SeenLight::Kind::spot;
      Eigen::Vector4d place = direction.homogeneous(), cone = direction.homogeneous();
      place[3] = 0;
      if (!parallel) place = own * light.position.homogeneous();
      cone[3] = spot ? std::cos(light.cutoff * std::numbers::pi / 180) : -1;
      places.push_back(place.cast<float>());
      colours.push_back(light.colour.homogeneous().cast<float>());
      cones.push_back(cone.cast<float>());
      falls.push_back({float(light.attenuation), float(light.exponent), 0, 0});
    }
    shaders.set("place", places);
    shaders.set("colour", colours);
    shaders.set("cone", cones);
    shaders.set("fall", falls);
    // with lights of the scene there is less of what has no place
    shaders.set("around", ambient_.value_or(Eigen::Vector3d::Constant(lights_.empty() ? 0.42 : 0.2)));
    shaders.set("fromAbove", ambient_ ? 0. : 0.18 / 0.42);
  }
  // Whether no edge of a mesh is seen longer than a few pixels: its light may be computed at corners.
  static bool isFine(ShadedMesh const& mesh, Camera const& camera, int height) {
    constexpr double most = 8;  // [pixels]
    const Eigen::Vector3d eye = camera.eye(), nearest = eye.cwiseMax(mesh.low).cwiseMin(mesh.high);
    const double wide = 2 * std::tan(camera.angle / 2 * std::numbers::pi / 180) * (nearest - eye).norm();
    return mesh.longest * height < most * wide;
  }
  // positive where something is seen
  static Eigen::Vector4d everything() { return {0, 0, 0, 1}; }
  Eigen::Vector4d clipped() const {
    if (!clip_) return everything();
    return {-clip_->normal[0], -clip_->normal[1], -clip_->normal[2], clip_->offset};
  }
  // parallel light onto the sphere around everything
  Eigen::Matrix4d lightOf(Eigen::Vector3d const& light) const {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.block<1, 3>(0, 0) = light.unitOrthogonal().transpose();
    m.block<1, 3>(1, 0) = light.cross(light.unitOrthogonal()).transpose();
    m.block<1, 3>(2, 0) = -light.transpose();
    m.topLeftCorner<3, 3>() /= Shadow::margin * radius_;
    m.block<3, 1>(0, 3) = -(m.topLeftCorner<3, 3>() * centre_);
    return m;
  }
  void findOcclusion(Eigen::Matrix4d const& toView, Eigen::Matrix4d const& toClip, int width, int height) {
    if (!occlusion_) occlusion_.emplace();
    occlusion_->make(toClip, width, height, occlusionRadius * radius_, [&] {
      depth_.use();
      depth_.set("toLight", Eigen::Matrix4d(toClip * toView));
      drawDepths(0);
    });
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, occlusion_->texture());
    glActiveTexture(GL_TEXTURE0);
  }
  void drawShadow(Eigen::Matrix4d const& toLight) {
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_.frame);
    glViewport(0, 0, shadow_.size, shadow_.size);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    depth_.use();
    depth_.set("toLight", toLight);
    drawDepths(1);
  }
  // of what hides; `which` list of the faces of bodies
  void drawDepths(std::size_t which) {
    depth_.set("clip", clipped());
    for (Body const& body : bodies_)
      if (!body.seenThrough()) body.drawn.faces.draw(GL_TRIANGLES, which);
    depth_.set("clip", everything());
    marks_.faces.draw(GL_TRIANGLES);
  }
  // Bodies that one sees through, the farthest first, of each the side that looks away first: each colour
  // goes onto what is behind it.
  template <class Faces, class Thin>
  void drawSeenThrough(Camera const& camera, Faces&& drawFaces, Thin&& drawThin) const {
    std::vector<std::pair<double, Body const*>> order;
    for (Body const& body : bodies_)
      if (body.seenThrough()) {
        ShadedMesh const& mesh = body.shaded.mesh();
        order.emplace_back(((mesh.low + mesh.high) / 2 - camera.eye()).norm(), &body);
      }
    if (order.empty()) return;
    std::sort(order.begin(), order.end(), [](auto const& a, auto const& b) { return a.first > b.first; });
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    for (auto const& [_, body] : order) {
      glEnable(GL_CULL_FACE);
      for (const GLenum hidden : {GLenum(GL_FRONT), GLenum(GL_BACK)}) {
        glCullFace(hidden);
        drawFaces(*body);
      }
      glDisable(GL_CULL_FACE);
      drawThin(*body);
    }
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }
  // legend, words and labels, in front of everything
  void drawWords(Camera const& camera, int width, int height) {
    if (!legend_ && words_.empty() && labels_.empty()) return;
    const double luminance = colour_.dot(Eigen::Vector3d(0.3, 0.6, 0.1));
    Overlay overlay(std::max(1., height / 480.), Eigen::Vector3d::Constant(luminance > 0.5 ? 0.1 : 0.95));
    if (legend_) overlay.addLegend(*legend_, width, height);
    overlay.addWords(words_, height);
    for (auto const& [place, label] : labels_) {
      const Eigen::Vector3d at = camera.project(place, width, height);
      if (at[2] > 0 && at[2] < 1) overlay.addText(at[0], at[1], label);
    }
    Eigen::Matrix4d toClip = Eigen::Matrix4d::Identity();
    toClip(0, 0) = 2. / width, toClip(1, 1) = -2. / height;
    toClip(0, 3) = -1, toClip(1, 3) = 1;
    glDisable(GL_DEPTH_TEST);
    plain_.use();
    plain_.set("toView", Eigen::Matrix4d(Eigen::Matrix4d::Identity()));
    plain_.set("toClip", toClip);
    plain_.set("clip", everything());
    plain_.set("roundPoints", 0);
    plain_.set("opacity", 1);
    overlay_.set(overlay.triangles().at, overlay.triangles().colours);
    overlay_.draw(GL_TRIANGLES);
    glEnable(GL_DEPTH_TEST);
  }
};

}  // namespace sinew::view
