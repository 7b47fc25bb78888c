// A program that knows nothing of Teren reads a file with a SoTerrain.
#include <string>

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/nodes/SoSeparator.h>
#include <gtest/gtest.h>

TEST(SoTerrainLibrary, IsLoadedByInventorItselfWhenAFileNamesTheNode) {
  SoDB::init();
  ASSERT_TRUE(SoType::fromName("SoTerrainMesh").isBad());
  const std::string text = "#Inventor V2.1 ascii\nSoTerrain { seed \"42\" waterLevel 12 }";
  SoInput input;
  input.setBuffer(text.data(), text.size());
  SoSeparator* root = SoDB::readAll(&input);
  ASSERT_NE(root, nullptr);
  root->ref();
  ASSERT_EQ(root->getNumChildren(), 1);
  SoNode* terrain = root->getChild(0);
  EXPECT_STREQ(terrain->getTypeId().getName().getString(), "SoTerrain");
  EXPECT_FALSE(terrain->isOfType(SoType::fromName("UnknownNode")));
  SbString level;
  ASSERT_NE(terrain->getField("waterLevel"), nullptr);
  terrain->getField("waterLevel")->get(level);
  EXPECT_STREQ(level.getString(), "12");
  root->unref();
}
