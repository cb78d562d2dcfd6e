#include "player/fleet/fleet_certificates.h"

#include <arpa/inet.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <utility>
#include <vector>

namespace lararium::player {
namespace {

constexpr int kDays = 3650;
constexpr long kSecondsBefore = 86400;  // Clocks of devices may be a day late.
constexpr size_t kSerialBytes = 16;
constexpr size_t kPasswordLetters = 20;
constexpr std::string_view kLetters = "abcdefghijkmnpqrstuvwxyz23456789";
// The program mosquitto_passwd uses these numbers.
constexpr int kIterations = 101;
constexpr size_t kSaltBytes = 12;
constexpr size_t kHashBytes = 64;

Status Problem() {
  return Status::Error("certificates", "OpenSSL cannot make them", "install libssl3 again");
}

template <typename Write>
std::string PemOf(Write write) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> out(BIO_new(BIO_s_mem()), &BIO_free);
  char* text = nullptr;
  write(out.get());
  const long size = BIO_get_mem_data(out.get(), &text);
  return {text, static_cast<size_t>(size)};
}

std::unique_ptr<BIO, decltype(&BIO_free)> Open(const std::string& pem) {
  return {BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())), &BIO_free};
}

std::string Base64(const unsigned char* bytes, size_t size) {
  std::string text(4 * ((size + 2) / 3) + 1, '\0');
  text.resize(static_cast<size_t>(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                                  bytes, static_cast<int>(size))));
  return text;
}

bool AddExtension(x509_st* certificate, x509_st* issuer, int id, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> extension(
      X509V3_EXT_conf_nid(nullptr, &context, id, value.c_str()), &X509_EXTENSION_free);
  return extension != nullptr && X509_add_ext(certificate, extension.get(), -1) == 1;
}

}  // namespace

// The content of a certificate that is to be made.
struct CertificateAuthority::Wish {
  std::string name;
  std::vector<std::pair<int, std::string>> extensions;  // OpenSSL's number, and value.
};

void CertificateAuthority::Free::operator()(evp_pkey_st* key) const { EVP_PKEY_free(key); }
void CertificateAuthority::Free::operator()(x509_st* certificate) const { X509_free(certificate); }

// issuer: nullptr: the certificate signs itself.
CertificateAuthority::Certificate CertificateAuthority::Sign(const Wish& wish,
                                                             evp_pkey_st* key,
                                                             x509_st* issuer,
                                                             evp_pkey_st* signer) {
  Certificate certificate(X509_new());
  x509_st* made = certificate.get();
  std::array<unsigned char, kSerialBytes> serial;
  if (made == nullptr || RAND_bytes(serial.data(), kSerialBytes) != 1) {
    return nullptr;
  }
  serial[0] &= 0x7f;  // Positive.
  const std::unique_ptr<BIGNUM, decltype(&BN_free)> number(
      BN_bin2bn(serial.data(), kSerialBytes, nullptr), &BN_free);
  issuer = issuer == nullptr ? made : issuer;
  X509_NAME* name = X509_get_subject_name(made);
  const auto* text = reinterpret_cast<const unsigned char*>(wish.name.c_str());
  bool good = X509_set_version(made, X509_VERSION_3) == 1 &&
              BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(made)) != nullptr &&
              X509_gmtime_adj(X509_getm_notBefore(made), -kSecondsBefore) != nullptr &&
              X509_time_adj_ex(X509_getm_notAfter(made), kDays, 0, nullptr) != nullptr &&
              X509_set_pubkey(made, key) == 1 &&
              X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_UTF8, text, -1, -1, 0) == 1 &&
              X509_set_issuer_name(made, X509_get_subject_name(issuer)) == 1;
  for (const auto& [id, value] : wish.extensions) {
    good = good && AddExtension(made, issuer, id, value);
  }
  return good && X509_sign(made, signer, EVP_sha256()) != 0 ? std::move(certificate) : nullptr;
}

Result<CertificateAuthority> CertificateAuthority::Make(const std::string& name) {
  Key key(EVP_EC_gen("P-256"));
  if (key == nullptr) {
    return Problem();
  }
  const Wish wish = {name,
                     {{NID_basic_constraints, "critical,CA:TRUE,pathlen:0"},
                      {NID_key_usage, "critical,keyCertSign,cRLSign"},
                      {NID_subject_key_identifier, "hash"}}};
  Certificate certificate = Sign(wish, key.get(), nullptr, key.get());
  if (certificate == nullptr) {
    return Problem();
  }
  return CertificateAuthority(std::move(certificate), std::move(key));
}

Result<CertificateAuthority> CertificateAuthority::Parse(const CertificateFiles& files,
                                                         std::string_view where) {
  Certificate certificate(
      PEM_read_bio_X509(Open(files.certificate).get(), nullptr, nullptr, nullptr));
  // Without the callback, OpenSSL would ask for the password of an encrypted key.
  const auto no_password = [](char* /*text*/, int /*size*/, int /*use*/, void* /*data*/) {
    return 0;
  };
  Key key(PEM_read_bio_PrivateKey(Open(files.key).get(), nullptr, no_password, nullptr));
  if (certificate == nullptr || key == nullptr ||
      X509_check_private_key(certificate.get(), key.get()) != 1) {
    return Status::Error(where, "is not a certificate with its key",
                         "put back both files, or begin in an empty folder");
  }
  return CertificateAuthority(std::move(certificate), std::move(key));
}

CertificateFiles CertificateAuthority::files() const {
  return {PemOf([this](BIO* out) { PEM_write_bio_X509(out, certificate_.get()); }),
          PemOf([this](BIO* out) {
            PEM_write_bio_PrivateKey(out, key_.get(), nullptr, nullptr, 0, nullptr, nullptr);
          })};
}

Result<CertificateFiles> CertificateAuthority::Issue(const Wish& wish) const {
  Key key(EVP_EC_gen("P-256"));
  Certificate certificate =
      key == nullptr ? nullptr : Sign(wish, key.get(), certificate_.get(), key_.get());
  if (certificate == nullptr) {
    return Problem();
  }
  return CertificateAuthority(std::move(certificate), std::move(key)).files();
}

Result<CertificateFiles> CertificateAuthority::MakeServer(const std::string& host) const {
  in6_addr address = {};
  const bool is_ip = inet_pton(AF_INET, host.c_str(), &address) == 1 ||
                     inet_pton(AF_INET6, host.c_str(), &address) == 1;
  return Issue({host,
                {{NID_basic_constraints, "critical,CA:FALSE"},
                 {NID_key_usage, "critical,digitalSignature"},
                 {NID_ext_key_usage, "serverAuth"},
                 {NID_authority_key_identifier, "keyid"},
                 {NID_subject_alt_name, (is_ip ? "IP:" : "DNS:") + host}}});
}

Result<CertificateFiles> CertificateAuthority::MakeClient(const std::string& name) const {
  return Issue({name,
                {{NID_basic_constraints, "critical,CA:FALSE"},
                 {NID_key_usage, "critical,digitalSignature"},
                 {NID_ext_key_usage, "clientAuth"},
                 {NID_authority_key_identifier, "keyid"}}});
}

Result<std::string> MakePassword() {
  std::array<unsigned char, kPasswordLetters> bytes;
  if (RAND_bytes(bytes.data(), bytes.size()) != 1) {
    return Problem();
  }
  std::string password;
  for (const unsigned char byte : bytes) {
    password += kLetters[byte % kLetters.size()];
  }
  return password;
}

Result<std::string> PasswordLine(std::string_view user, std::string_view password) {
  std::array<unsigned char, kSaltBytes> salt;
  std::array<unsigned char, kHashBytes> hash;
  if (RAND_bytes(salt.data(), salt.size()) != 1 ||
      PKCS5_PBKDF2_HMAC(password.data(), static_cast<int>(password.size()), salt.data(),
                        salt.size(), kIterations, EVP_sha512(), hash.size(), hash.data()) != 1) {
    return Problem();
  }
  return std::string(user) + ":$7$" + std::to_string(kIterations) + "$" +
         Base64(salt.data(), salt.size()) + "$" + Base64(hash.data(), hash.size()) + "\n";
}

}  // namespace lararium::player
