#include "apps/fly/DepthShader.h"

#include <string>

#include <Inventor/nodes/SoFragmentShader.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShaderParameter.h>
#include <Inventor/nodes/SoShaderProgram.h>
#include <Inventor/nodes/SoSwitch.h>

#include "coin/LogarithmicDepth.h"

namespace teren {

DepthShader::DepthShader() : root_(new SoSeparator), switch_(new SoSwitch), scale_(new SoShaderParameter2f) {
  root_->ref();
  root_->renderCaching = SoSeparator::OFF;
  root_->renderCulling = SoSeparator::OFF;
  scale_->name = "depthScale";
  const std::string text = std::string("#version 120\n") + kLogarithmicDepthShader +
                           "void main() { gl_FragColor = gl_Color; writeDepth(); }\n";
  auto* shader = new SoFragmentShader;
  shader->sourceType = SoShaderObject::GLSL_PROGRAM;
  shader->sourceProgram = text.c_str();
  shader->parameter = scale_;
  auto* program = new SoShaderProgram;
  program->shaderObject = shader;
  switch_->whichChild = SO_SWITCH_NONE;
  switch_->addChild(program);
  switch_->whichChild.enableNotify(FALSE);
  root_->addChild(switch_);
}

DepthShader::~DepthShader() {
  root_->unref();
}

void DepthShader::turnOn(bool on) {
  switch_->whichChild = on ? 0 : SO_SWITCH_NONE;
}

void DepthShader::setPlanes(float nearest, float farthest) {
  scale_->value = depthScale(nearest, farthest);
}

}  // namespace teren
