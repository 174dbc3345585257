#include "net/connection_tickets.h"

#include "net/client_address.h"

#include <algorithm>
#include <utility>

namespace froxel::net {

namespace {

// Clients that are slow to begin must not be driven out by others of their address.
constexpr Seconds kOwnPatience{1};

} // namespace

struct ConnectionTickets::Book {
    using Entry = Ticket::Entry;
    using Entries = std::list<Entry>;

    [[nodiscard]] uint32_t of(const std::string& account) const {
        const auto found = by_account.find(account);
        return found == by_account.end() ? 0 : found->second;
    }
    void uncount(Entry& entry) {
        if (std::exchange(entry.counted, false)) {
            --total;
            if (--entry.account->second == 0) {
                by_account.erase(entry.account);
            }
        }
    }
    void giveWay(Entry& entry) {
        uncount(entry);
        entry.waits_since.reset();
        std::exchange(entry.close, nullptr)();
    }
    // Whether one of another account, which has more, made room for the newcomer's.
    bool makeRoom(const std::string& newcomer) {
        const uint32_t own = of(newcomer);
        auto best = entries.end();
        for (auto entry = entries.begin(); entry != entries.end(); ++entry) {
            if (!entry->waits_since || entry->account->second <= own + 1) {
                continue;
            }
            const auto order = [](const Entry& of) {
                return std::pair(of.account->second, -of.waits_since->time_since_epoch());
            };
            if (best == entries.end() || order(*entry) > order(*best)) {
                best = entry;
            }
        }
        if (best == entries.end()) {
            return false;
        }
        giveWay(*best);
        return true;
    }
    bool makeOwnRoom(const std::string& newcomer, TimePoint now) {
        auto longest = entries.end();
        for (auto entry = entries.begin(); entry != entries.end(); ++entry) {
            if (entry->waits_since && entry->account->first == newcomer &&
                now - *entry->waits_since >= kOwnPatience &&
                (longest == entries.end() || *entry->waits_since < *longest->waits_since)) {
                longest = entry;
            }
        }
        if (longest == entries.end()) {
            return false;
        }
        giveWay(*longest);
        return true;
    }

    std::mutex mutex;
    Entries entries;
    Ticket::Counts by_account;
    uint32_t total = 0;
};

ConnectionTickets::Ticket::Ticket(std::shared_ptr<Book> book, std::list<Entry>::iterator entry)
    : book_(std::move(book)), entry_(entry) {}

ConnectionTickets::Ticket::~Ticket() {
    std::function<void()> close; // goes without the lock: it may hold the connection's last part
    const std::lock_guard lock(book_->mutex);
    close = std::exchange(entry_->close, nullptr);
    book_->uncount(*entry_);
    book_->entries.erase(entry_);
}

void ConnectionTickets::Ticket::waitForClient(std::function<void()> close, TimePoint now) {
    const std::lock_guard lock(book_->mutex);
    if (entry_->counted) {
        entry_->close = std::move(close);
        entry_->waits_since = now;
    }
}

void ConnectionTickets::Ticket::heardClient() {
    const std::lock_guard lock(book_->mutex);
    entry_->waits_since.reset();
}

ConnectionTickets::ConnectionTickets(uint32_t connections_max)
    : connections_max_(connections_max), book_(std::make_shared<Book>()) {}

std::shared_ptr<ConnectionTickets::Ticket>
ConnectionTickets::take(const boost::asio::ip::address& peer, uint32_t account_max, TimePoint now) {
    std::string account = callerAt(peer).address.key;
    std::list<Ticket::Entry>::iterator entry;
    {
        const std::lock_guard lock(book_->mutex);
        if (book_->of(account) >= account_max && !book_->makeOwnRoom(account, now)) {
            return nullptr;
        }
        if (book_->total >= connections_max_ && !book_->makeRoom(account) &&
            !book_->makeOwnRoom(account, now)) {
            return nullptr;
        }
        const auto counted = book_->by_account.try_emplace(std::move(account), 0).first;
        entry = book_->entries.insert(book_->entries.end(), Ticket::Entry{counted});
        ++counted->second;
        ++book_->total;
    } // a ticket that memory does not suffice for is dropped, which locks
    return std::shared_ptr<Ticket>(new Ticket(book_, entry));
}

} // namespace froxel::net
