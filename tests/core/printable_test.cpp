#include "core/printable.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(Printable, TextStaysWhatItIs) {
  for (const char* text : {"", "a b\tc\n", "µm, °, 輪, 😀, \u00A0"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, WhatATerminalObeysIsSpelledOut) {
  EXPECT_EQ(printable("a\x1B[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(printable(std::string_view("\0\a\b\r\x7F", 5)), "\\x00\\x07\\x08\\x0d\\x7f");
  EXPECT_EQ(printable("\xC2\x9B"), "\\xc2\\x9b") << "the control sequence introducer of one byte";
}

TEST(Printable, BytesThatAreNoUtf8AreSpelledOut) {
  EXPECT_EQ(printable("\xDF"), "\\xdf");
  EXPECT_EQ(printable("\xC0\xAF"), "\\xc0\\xaf");
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(printable("\xF5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  EXPECT_EQ(printable("\xE2\x82"), "\\xe2\\x82") << "cut within a character";
}

TEST(Printable, BytesThatAreNoUtf8AreReadAsThoseOfWindows1252) {
  EXPECT_EQ(decoded("Müll 20 µm").text, "Müll 20 µm");
  EXPECT_FALSE(decoded("Müll 20 µm").from_windows_1252);
  EXPECT_EQ(decoded("M\xFCll 20 \xB5m, \x80 5 \x96 6").text, "Müll 20 µm, € 5 – 6");
  EXPECT_TRUE(decoded("\xFC").from_windows_1252);
}

TEST(Printable, ABinaryFileIsKnownByItsControlCharacters) {
  EXPECT_EQ(sign_of_binary("a\tb\r\n\v\f\x1A"), "");
  EXPECT_EQ(sign_of_binary("Schie\xDF"
                           "en"),
            "");
  EXPECT_EQ(sign_of_binary(std::string_view("a\n\0b", 4)), "line 2 has the byte 0x00");
  EXPECT_EQ(sign_of_binary("\x1B"), "line 1 has the byte 0x1B");
}

}  // namespace
}  // namespace railstrata
