// What the page fetches of its server besides the connection, by the token that it has.

const kMostPictures = 200;

export class ServerFiles {
  private readonly pictures = new Map<string, string | null>(); // object URLs by path, oldest first

  /** Empty: none is needed. */
  constructor(private readonly token: () => string) {}

  /** Of a path below the page's own. */
  get(path: string, method = 'GET'): Promise<Response> {
    const token = this.token();
    const headers: HeadersInit = token === '' ? {} : { Authorization: `Bearer ${token}` };
    return fetch(new URL(path.replace(/^\//, ''), document.baseURI), { method, headers });
  }

  /** Whether scenes may be brought to this server. */
  async takesUploads(): Promise<boolean> {
    const answer = await this.get('api/v1/uploads', 'OPTIONS').catch(() => null);
    return answer?.headers.has('Tus-Version') ?? false;
  }

  /** What an image shows of it; null: it is not to be had, whyever. Fetched once. */
  async picture(path: string): Promise<string | null> {
    const known = this.pictures.get(path);
    if (known !== undefined) return known;
    const answer = await this.get(path).catch(() => null);
    if (!answer?.ok) return null; // it may be had later
    const url = answer.status === 204 ? null : URL.createObjectURL(await answer.blob());
    this.pictures.set(path, url);
    const [oldest] = this.pictures.keys();
    if (this.pictures.size > kMostPictures && oldest !== undefined) {
      URL.revokeObjectURL(this.pictures.get(oldest) ?? '');
      this.pictures.delete(oldest);
    }
    return url;
  }
}

/** Why a request was refused, in the server's words where it has some. */
export async function reasonOf(answer: Response): Promise<string> {
  const text = await answer.text();
  try {
    const { message } = JSON.parse(text) as { message?: unknown };
    return typeof message === 'string' ? message : `HTTP ${answer.status}`;
  } catch {
    return text.trim().slice(0, 200) || `HTTP ${answer.status}`;
  }
}
